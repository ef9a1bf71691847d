#pragma once

#include <string_view>

namespace mane::tool {

/// The playing page without a run, as viewer/ builds it. Throws InputError where `mane` was built
/// without its pages.
std::string_view view_page();

} // namespace mane::tool
