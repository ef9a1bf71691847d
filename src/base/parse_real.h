#pragma once

#include <string_view>

namespace mane {

/// Reads all of `text` as a decimal number, exactly rounded, whatever the program's locale: sign,
/// digits, point, exponent; "inf" and "nan" too. False if it is none or too large. The only place
/// where text becomes a real: scene files, `--set`, BVH and OBJ read the same bits everywhere.
bool parse_real(std::string_view text, double& x);
bool parse_real(std::string_view text, float& x);

} // namespace mane
