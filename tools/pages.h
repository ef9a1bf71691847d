#pragma once

#include <string_view>

namespace mane::tool {

/// The playing page without a run, as viewer/ builds it. Throws InputError where `mane` was built
/// without its pages.
std::string_view view_page();

/// The live page and its solvers, as viewer/ and viewer/wasm/ build them.
struct LiveFiles {
    std::string_view page;                                           ///< without a solver
    std::string_view script, module;                                 ///< for one thread
    std::string_view threads_script, threads_module, threads_worker; ///< for several
};
/// Throws InputError where `mane` was built without them.
LiveFiles live_files();

} // namespace mane::tool
