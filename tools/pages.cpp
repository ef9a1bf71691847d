#include "pages.h"

#include "mane/error.h"

// The assembler puts files into the program as they are: as strings in C++ they would take the
// compiler minutes. `name`: a function that gives the file.
#define MANE_EMBED(name, file)                                                                     \
    asm(".section .rodata\n" #name "_begin:\n.incbin \"" file "\"\n" #name "_end:\n.previous\n");  \
    extern "C" const char name##_begin[], name##_end[];                                            \
    static std::string_view name() {                                                               \
        return {name##_begin, name##_end};                                                         \
    }

#ifdef MANE_VIEW_PAGE
MANE_EMBED(embedded_view, MANE_VIEW_PAGE)
#endif
#ifdef MANE_LIVE_FILES
MANE_EMBED(embedded_live, MANE_LIVE_PAGE)
MANE_EMBED(embedded_script, MANE_LIVE_FILES "/solver.js")
MANE_EMBED(embedded_module, MANE_LIVE_FILES "/solver.wasm")
MANE_EMBED(embedded_threads_script, MANE_LIVE_FILES "/solver_threads.js")
MANE_EMBED(embedded_threads_module, MANE_LIVE_FILES "/solver_threads.wasm")
MANE_EMBED(embedded_threads_worker, MANE_LIVE_FILES "/solver_threads.worker.js")
#endif

namespace mane::tool {

std::string_view view_page() {
#ifdef MANE_VIEW_PAGE
    return embedded_view();
#else
    throw InputError("this mane was built without its pages: install npm and build with "
                     "-DMANE_VIEWER=ON");
#endif
}

LiveFiles live_files() {
#ifdef MANE_LIVE_FILES
    return {embedded_live(),           embedded_script(),         embedded_module(),
            embedded_threads_script(), embedded_threads_module(), embedded_threads_worker()};
#else
    throw InputError("this mane was built without its live page: install npm and emscripten and "
                     "build with -DMANE_LIVE=ON");
#endif
}

} // namespace mane::tool
