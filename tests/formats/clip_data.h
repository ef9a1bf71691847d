#pragma once

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

/// The path of a file of the shared data, or empty, with a message, where it is missing: a failure
/// on CI.
inline std::string shared_data(const std::string& name) {
    const char* folder = std::getenv("MANE_DATA");
    const std::string path =
        (folder ? std::string(folder) : MANE_SOURCE_DIR "/../shared/data") + "/" + name;
    if (std::filesystem::exists(path))
        return path;
    const char* ci = std::getenv("CI");
    if (ci && std::string(ci) == "true")
        FAIL_CHECK(path, " is missing");
    MESSAGE("skipped: ", path, " is missing");
    return {};
}

/// A text file that lives as long as this.
class TextFile {
  public:
    TextFile(const std::string& name, const std::string& text)
        : path_((std::filesystem::temp_directory_path() / ("mane_import_" + name)).string()) {
        std::ofstream(path_, std::ios::binary) << text;
    }
    ~TextFile() { std::filesystem::remove(path_); }
    TextFile(const TextFile&) = delete;
    TextFile& operator=(const TextFile&) = delete;
    const std::string& path() const { return path_; }

  private:
    std::string path_;
};
