// Preloaded into sanitized tests that compile many shaders. The driver's compiler, which is C++,
// then takes its memory from the C library: with the address sanitizer's, such a test takes up to
// three quarters more time. Our own C code is checked as before. Tests of C++ libraries that read
// untrusted files (tinygltf) run without this.

#include <cstddef>
#include <new>

#include <malloc.h>
#include <unistd.h>

// The C library's own names, which sanitizers do not replace.
extern "C" void *__libc_malloc(std::size_t size);
extern "C" void *__libc_memalign(std::size_t alignment, std::size_t size);
extern "C" void __libc_free(void *block);

static void *allocate(std::size_t size) noexcept {
    return __libc_malloc(size ? size : 1);
}

static void *allocate(std::size_t size, std::align_val_t alignment) noexcept {
    return __libc_memalign(static_cast<std::size_t>(alignment), size ? size : 1);
}

static void *or_throw(void *block) {
    if (!block)
        throw std::bad_alloc();
    return block;
}

void *operator new(std::size_t size) {
    return or_throw(allocate(size));
}
void *operator new[](std::size_t size) {
    return or_throw(allocate(size));
}
void *operator new(std::size_t size, const std::nothrow_t &) noexcept {
    return allocate(size);
}
void *operator new[](std::size_t size, const std::nothrow_t &) noexcept {
    return allocate(size);
}
void *operator new(std::size_t size, std::align_val_t alignment) {
    return or_throw(allocate(size, alignment));
}
void *operator new[](std::size_t size, std::align_val_t alignment) {
    return or_throw(allocate(size, alignment));
}
void *operator new(std::size_t size, std::align_val_t alignment, const std::nothrow_t &) noexcept {
    return allocate(size, alignment);
}
void *operator new[](std::size_t size, std::align_val_t alignment,
                     const std::nothrow_t &) noexcept {
    return allocate(size, alignment);
}

void operator delete(void *block) noexcept {
    __libc_free(block);
}
void operator delete[](void *block) noexcept {
    __libc_free(block);
}
void operator delete(void *block, std::size_t) noexcept {
    __libc_free(block);
}
void operator delete[](void *block, std::size_t) noexcept {
    __libc_free(block);
}
void operator delete(void *block, const std::nothrow_t &) noexcept {
    __libc_free(block);
}
void operator delete[](void *block, const std::nothrow_t &) noexcept {
    __libc_free(block);
}
void operator delete(void *block, std::align_val_t) noexcept {
    __libc_free(block);
}
void operator delete[](void *block, std::align_val_t) noexcept {
    __libc_free(block);
}
void operator delete(void *block, std::size_t, std::align_val_t) noexcept {
    __libc_free(block);
}
void operator delete[](void *block, std::size_t, std::align_val_t) noexcept {
    __libc_free(block);
}
void operator delete(void *block, std::align_val_t, const std::nothrow_t &) noexcept {
    __libc_free(block);
}
void operator delete[](void *block, std::align_val_t, const std::nothrow_t &) noexcept {
    __libc_free(block);
}

// The compiler's objects own blocks of the address sanitizer's, which would count as leaks: the
// leak checker looks for pointers to them in its own blocks only. It would find out, by reading the
// debug information of all libraries for a third of a second, that leaks.supp names them.

extern "C" __attribute__((weak)) void __lsan_register_root_region(const void *begin,
                                                                  std::size_t size);

static const char *heap;

__attribute__((constructor)) static void note_begin_of_heap() {
    heap = static_cast<const char *>(sbrk(0));
}

__attribute__((destructor)) static void show_heap_to_leak_checker() {
    const auto size = static_cast<std::size_t>(static_cast<const char *>(sbrk(0)) - heap);
    // What was never used lies at the end, and is large.
    const std::size_t unused = mallinfo2().keepcost;
    if (__lsan_register_root_region && unused <= size)
        __lsan_register_root_region(heap, size - unused);
}
