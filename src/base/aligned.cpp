#include "base/aligned.h"

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace mane {
namespace {

constexpr std::size_t kLargePage = std::size_t{2} << 20;

std::align_val_t alignment(std::size_t bytes) {
    return std::align_val_t{bytes >= 2 * kLargePage ? kLargePage : 64};
}

} // namespace

void* allocate_aligned(std::size_t bytes) {
    void* memory = ::operator new(bytes, alignment(bytes));
#if defined(__linux__) && defined(MADV_HUGEPAGE)
    if (bytes >=
        2 * kLargePage) // whole pages of it; a system without them says no, and all is well
        madvise(memory, bytes / kLargePage * kLargePage, MADV_HUGEPAGE);
#endif
    return memory;
}

void free_aligned(void* memory, std::size_t bytes) {
    ::operator delete(memory, alignment(bytes));
}

} // namespace mane
