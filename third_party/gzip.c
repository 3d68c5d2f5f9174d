#include "third_party/gzip.h"

#include <stdio.h>

#include <zlib.h>

// zlib's name for "a window of 32 KiB, with the header and checksum of gzip".
enum { GZIP_WINDOW = 15 + 16, PIECE = 1 << 16 };

typedef struct gzip_job {
    z_stream stream;
    uint8_t *bytes; // unpacked so far
    size_t size, room, maximum;
    size_t left; // packed bytes not yet passed to zlib
    library_memory *memory;
    const char *cause;
} gzip_job;

bool third_party_gzip_recognise(const void *bytes, size_t size) {
    const uint8_t *first = bytes;
    return size >= 2 && first[0] == 0x1f && first[1] == 0x8b;
}

static bool fail(gzip_job *job, const char *cause) {
    job->cause = cause;
    return false;
}

static voidpf allocate(voidpf user, uInt count, uInt size) {
    return library_memory_resize(user, NULL, (size_t)count * size);
}

static void release(voidpf user, voidpf piece) {
    ((library_memory *)user)->release(piece);
}

// Makes room for another chunk and a final zero byte.
static bool grow(gzip_job *job) {
    if (job->room - job->size > PIECE)
        return true;
    size_t room = 2 * job->room + 2 * PIECE;
    uint8_t *larger = library_memory_resize(job->memory, job->bytes, room);
    if (!larger)
        return fail(job, "out of memory");
    job->bytes = larger;
    job->room = room;
    return true;
}

// zlib counts in 32 bits.
static void feed(gzip_job *job) {
    if (job->stream.avail_in > 0 || job->left == 0)
        return;
    job->stream.avail_in = (uInt)(job->left < PIECE ? job->left : PIECE);
    job->left -= job->stream.avail_in;
}

static bool unpack_piece(gzip_job *job, bool *ended) {
    if (!grow(job))
        return false;
    feed(job);
    job->stream.next_out = job->bytes + job->size;
    job->stream.avail_out = PIECE;
    int status = inflate(&job->stream, Z_NO_FLUSH);
    job->size += PIECE - job->stream.avail_out;
    if (job->size > job->maximum)
        return fail(job, "larger than lobe unpacks");
    *ended = status == Z_STREAM_END;
    if (status == Z_BUF_ERROR)
        return fail(job, "ends early");
    if (status == Z_MEM_ERROR)
        return fail(job, "out of memory");
    return status == Z_OK || *ended || fail(job, "broken gzip data");
}

static bool unpack(gzip_job *job) {
    bool ended = false;
    while (!ended || job->stream.avail_in > 0 || job->left > 0) {
        if (ended && inflateReset(&job->stream) != Z_OK)
            return fail(job, "broken gzip data");
        if (!unpack_piece(job, &ended))
            return false;
    }
    return true;
}

bool third_party_gzip_unpack(const void *bytes, size_t size, size_t maximum, library_memory *memory,
                             uint8_t **unpacked, size_t *unpacked_size,
                             char message[GZIP_MESSAGE_SIZE]) {
    gzip_job job = {.maximum = maximum, .left = size, .memory = memory};
    job.stream.next_in = (Bytef *)bytes; // read only
    job.stream.zalloc = allocate;
    job.stream.zfree = release;
    job.stream.opaque = memory;
    bool started = inflateInit2(&job.stream, GZIP_WINDOW) == Z_OK;
    bool done = started ? unpack(&job) : fail(&job, "out of memory");
    inflateEnd(&job.stream);
    if (done) {
        job.bytes[job.size] = 0;
    } else {
        snprintf(message, GZIP_MESSAGE_SIZE, "%s", job.cause);
        memory->release(job.bytes);
        job.bytes = NULL;
    }
    *unpacked = job.bytes;
    *unpacked_size = done ? job.size : 0;
    return done;
}
