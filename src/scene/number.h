#pragma once

#include "base/parse_real.h"

#include <locale>
#include <sstream>
#include <string>

namespace mane {

/// The shortest text that reads back as the same number; plain digits where they are few.
/// With streams, because the library of WebAssembly has no std::to_chars for reals yet.
template <typename Real> std::string shortest(Real x) {
    const Real size = x < 0 ? -x : x;
    const bool plain = size == 0 || (size >= Real(1e-6) && size < Real(1e10));
    std::string text;
    for (int digits = plain ? 0 : 1; digits < 26; ++digits) {
        std::ostringstream out;
        out.imbue(std::locale::classic());
        if (plain)
            out.setf(std::ios::fixed, std::ios::floatfield);
        out.precision(digits);
        out << x;
        text = out.str();
        if (Real back{}; parse_real(text, back) && back == x)
            break;
    }
    return text;
}

} // namespace mane
