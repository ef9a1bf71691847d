#include "formats/text.h"

#include "base/parse_real.h"
#include "mane/error.h"

#include <charconv>
#include <fstream>
#include <iterator>

namespace mane {

std::string read_text(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    if (!file)
        throw InputError(path + ": cannot be opened; expected a readable file");
    std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    if (file.bad())
        throw InputError(path + ": cannot be read to its end");
    return text;
}

bool LineReader::next(Line& line) {
    if (rest_.empty())
        return false;
    const std::size_t end = rest_.find('\n');
    std::string_view text = rest_.substr(0, end);
    rest_.remove_prefix(end == std::string_view::npos ? rest_.size() : end + 1);
    if (!text.empty() && text.back() == '\r')
        text.remove_suffix(1);
    line = {text, ++number_};
    return true;
}

std::string_view take_word(std::string_view& text) {
    const char* blanks = " \t\r\v\f";
    const std::size_t begin = text.find_first_not_of(blanks);
    if (begin == std::string_view::npos) {
        text = {};
        return {};
    }
    text.remove_prefix(begin);
    const std::string_view word = text.substr(0, text.find_first_of(blanks));
    text.remove_prefix(word.size());
    return word;
}

bool parse_number(std::string_view word, double& number) {
    return parse_real(word, number);
}
bool parse_number(std::string_view word, long long& number) {
    if (word.size() > 1 && word.front() == '+')
        word.remove_prefix(1);
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    return error == std::errc() && end == word.data() + word.size();
}

void fail_at(const std::string& path, std::size_t line, const std::string& what) {
    throw InputError(path + ":" + std::to_string(line) + ": " + what);
}

} // namespace mane
