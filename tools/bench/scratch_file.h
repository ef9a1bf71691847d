#pragma once

#include <filesystem>
#include <string>
#include <unistd.h>

namespace mane::bench {

/// A file's place among the temporary ones, free again at the end.
class ScratchFile {
  public:
    ScratchFile()
        : path_(std::filesystem::temp_directory_path() /
                ("mane_bench_" + std::to_string(getpid()) + ".mane")) {}
    ~ScratchFile() {
        std::error_code ignored;
        std::filesystem::remove(path_, ignored);
    }
    ScratchFile(const ScratchFile&) = delete;
    ScratchFile& operator=(const ScratchFile&) = delete;

    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

} // namespace mane::bench
