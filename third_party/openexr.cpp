#include "third_party/openexr.h"

#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <stdexcept>
#include <vector>

#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>

namespace {

class MemoryStream : public Imf::IStream {
  public:
    MemoryStream(const void *bytes, size_t size)
        : Imf::IStream(""), bytes(static_cast<const char *>(bytes)), size(size) {
    }

    bool read(char *target, int count) override {
        if (count < 0 || position > size || uint64_t(count) > size - position)
            throw std::runtime_error("ends early");
        std::memcpy(target, bytes + position, size_t(count));
        position += uint64_t(count);
        return position < size;
    }

    uint64_t tellg() override {
        return position;
    }
    void seekg(uint64_t target) override {
        position = target;
    }

  private:
    const char *bytes;
    uint64_t size, position = 0;
};

// Writes each row of the image to the same memory (a stride of 0).
Imf::FrameBuffer one_row(const openexr_source &source, int left, std::vector<float> &row) {
    Imf::FrameBuffer buffer;
    for (int i = 0; i < 4; i++) {
        if (!source.channels[i])
            continue;
        Imf::Slice slice = Imf::Slice::Make(Imf::FLOAT, row.data() + i, Imath::V2i(left, 0),
                                            int64_t(row.size() / 4), 1, 4 * sizeof(float));
        slice.yStride = 0;
        buffer.insert(source.channels[i], slice);
    }
    return buffer;
}

void read_rows(const openexr_source &source) {
    MemoryStream stream(source.bytes, source.size);
    Imf::MultiPartInputFile file(stream, 0, false);
    Imf::InputPart part(file, source.part);
    const Imath::Box2i &window = part.header().dataWindow();
    const int64_t width = int64_t(window.max.x) - window.min.x + 1;
    std::vector<float> row(4 * size_t(width), 1.0f);
    part.setFrameBuffer(one_row(source, window.min.x, row));
    for (int64_t y = window.min.y; y <= window.max.y; y++) {
        part.readPixels(int(y));
        source.place(source.user, int(y), row.data());
    }
}

// The library's message may quote the file: keep only printable ASCII.
void copy_message(const char *from, char message[OPENEXR_MESSAGE_SIZE]) {
    std::snprintf(message, OPENEXR_MESSAGE_SIZE, "%s", from);
    for (; *message; message++) {
        if (*message < ' ' || *message > '~')
            *message = '?';
    }
}

} // namespace

extern "C" bool third_party_openexr_read(const openexr_source *source,
                                         char message[OPENEXR_MESSAGE_SIZE]) {
    const char *cause = "unknown";
    try {
        read_rows(*source);
        return true;
    } catch (const std::bad_alloc &) {
        cause = "out of memory";
    } catch (const std::exception &exception) {
        copy_message(exception.what(), message);
        return false;
    } catch (...) {
    }
    std::snprintf(message, OPENEXR_MESSAGE_SIZE, "%s", cause);
    return false;
}
