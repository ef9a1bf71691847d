#include "pages.h"

#include "mane/error.h"

// The assembler puts the page into the program as it is: as a string in C++ it would take the
// compiler minutes.
#ifdef MANE_VIEW_PAGE
asm(".section .rodata\n"
    "mane_view_page_begin:\n"
    ".incbin \"" MANE_VIEW_PAGE "\"\n"
    "mane_view_page_end:\n"
    ".previous\n");
extern "C" const char mane_view_page_begin[], mane_view_page_end[];
#endif

namespace mane::tool {

std::string_view view_page() {
#ifdef MANE_VIEW_PAGE
    return {mane_view_page_begin, mane_view_page_end};
#else
    throw InputError("this mane was built without its pages: install npm and build with "
                     "-DMANE_VIEWER=ON");
#endif
}

} // namespace mane::tool
