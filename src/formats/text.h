#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace mane {

/// A whole text file. Throws InputError if it is missing or cannot be read.
std::string read_text(const std::string& path);

/// A line of a text without its end, and its number.
struct Line {
    std::string_view text;
    std::size_t number = 0; // from 1
};

/// Goes through a text line by line; "\n" and "\r\n" end a line.
class LineReader {
  public:
    explicit LineReader(std::string_view text) : rest_(text) {}
    /// False at the end of the text.
    bool next(Line& line);
    /// The number of lines given so far.
    std::size_t number() const { return number_; }

  private:
    std::string_view rest_;
    std::size_t number_ = 0;
};

/// Takes the first word off `text`; empty when there is none. Spaces and tabs separate words.
std::string_view take_word(std::string_view& text);

/// The number that `word` is, all of it. False if it is none; "nan" and "inf" are numbers here, the
/// callers refuse them.
bool parse_number(std::string_view word, double& number);
bool parse_number(std::string_view word, long long& number);

/// "path:12: " in front of `what`, thrown as InputError.
[[noreturn]] void fail_at(const std::string& path, std::size_t line, const std::string& what);

} // namespace mane
