#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace mane {

/// Memory on borders of 64 bytes, one cache line and the widest vector; from some megabytes on, of
/// large pages where the system has them: what is gone through every step would else wait for the
/// addresses of its pages.
void* allocate_aligned(std::size_t bytes);
void free_aligned(void* memory, std::size_t bytes);

template <typename T> struct AlignedAllocator {
    using value_type = T;

    AlignedAllocator() = default;
    template <typename U> AlignedAllocator(const AlignedAllocator<U>&) {}
    T* allocate(std::size_t n) { return static_cast<T*>(allocate_aligned(n * sizeof(T))); }
    void deallocate(T* p, std::size_t n) { free_aligned(p, n * sizeof(T)); }
    bool operator==(const AlignedAllocator&) const { return true; }
};

template <typename T> using AlignedVector = std::vector<T, AlignedAllocator<T>>;

} // namespace mane
