#pragma once

#include <cstdio>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace mane {

/// A file that appears whole or not at all: it is written beside its place, with ".part" behind its
/// name, and renamed by `finish`. Without that, the part is removed. Failures throw InputError with
/// the path and the system's reason.
class WholeFile {
  public:
    explicit WholeFile(std::filesystem::path path);
    ~WholeFile();
    WholeFile(const WholeFile&) = delete;
    WholeFile& operator=(const WholeFile&) = delete;

    void write(const void* data, std::size_t size);
    void write(std::string_view text) { write(text.data(), text.size()); }
    /// The bytes of numbers as they are in memory.
    template <typename T> void write_numbers(std::span<const T> numbers) {
        write(numbers.data(), numbers.size_bytes());
    }
    /// Puts the file in its place.
    void finish();

  private:
    [[noreturn]] void fail(const std::string& reason) const;

    std::filesystem::path path_, part_; // the same where it is written in place
    std::FILE* file_;
};

} // namespace mane
