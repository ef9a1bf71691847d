#include "base/parse_real.h"

#include <charconv>
#include <cmath>
#include <cstdlib>
#include <string>

namespace mane {
namespace {

#ifdef __cpp_lib_to_chars

template <typename Real> bool parse_plain(std::string_view text, Real& x) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), x);
    return error == std::errc() && end == text.data() + text.size();
}

#else

// The C++ library of Emscripten 3.1 has std::from_chars for whole numbers only. Its strtod is
// musl's: exactly rounded, in the one locale that there is. It takes more than from_chars, though:
// blanks, a second sign, hexadecimal digits.
void convert(const char* text, char** end, double& x) {
    x = std::strtod(text, end);
}
void convert(const char* text, char** end, float& x) {
    x = std::strtof(text, end);
}

template <typename Real> bool parse_plain(std::string_view text, Real& x) {
    const std::string_view digits = text.substr(text.starts_with('-'));
    const bool named = digits.starts_with('i') || digits.starts_with('n') ||
                       digits.starts_with('I') || digits.starts_with('N');
    if (!named && digits.find_first_not_of("0123456789.eE+-") != std::string_view::npos)
        return false;
    if (digits.empty() || digits.front() == '+' || digits.front() == '-')
        return false;
    const std::string ended(text);
    char* end = nullptr;
    convert(ended.c_str(), &end, x);
    return end == ended.c_str() + ended.size() && (named || std::isfinite(x));
}

#endif

template <typename Real> bool parse_signed(std::string_view text, Real& x) {
    if (text.size() > 1 && text[0] == '+' && text[1] != '-')
        text.remove_prefix(1);
    return parse_plain(text, x);
}

} // namespace

bool parse_real(std::string_view text, double& x) {
    return parse_signed(text, x);
}
bool parse_real(std::string_view text, float& x) {
    return parse_signed(text, x);
}

} // namespace mane
