#pragma once

#include <optional>
#include <string_view>

namespace mane {

/// What one `written` is in a field's `unit`: factor("cm", "m") = 0.01. Nothing when they do not
/// measure the same.
std::optional<double> unit_factor(std::string_view written, std::string_view unit);

} // namespace mane
