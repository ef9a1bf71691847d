#pragma once

#include <charconv>
#include <cmath>
#include <string>

namespace mane {

/// The shortest text that reads back as the same number; plain digits where they are few.
template <typename Real> std::string shortest(Real x) {
    const Real size = std::fabs(x);
    const bool plain = size == 0 || (size >= Real(1e-6) && size < Real(1e10));
    char text[64];
    const auto end = std::to_chars(text, text + sizeof text, x,
                                   plain ? std::chars_format::fixed : std::chars_format::general);
    return {text, end.ptr};
}

} // namespace mane
