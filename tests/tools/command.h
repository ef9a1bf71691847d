#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

#include <sys/wait.h>

namespace fs = std::filesystem;

/// A folder of the test's own with a small scene in it.
struct Folder {
    fs::path path =
        fs::temp_directory_path() / ("mane_command_" + std::to_string(std::random_device{}()));
    Folder() {
        fs::create_directories(path);
        write("small.toml",
              "[style]\nwisps = 8\nsegments = 4\nnape_length = 0.15\ncrown_length = 0.15\n"
              "[schedule]\nframes = 4\npreroll = 0\n");
    }
    ~Folder() { fs::remove_all(path); }
    std::string operator/(const char* name) const { return (path / name).string(); }
    void write(const char* name, const std::string& text) const {
        std::ofstream(path / name, std::ios::binary) << text;
    }
    std::string read(const char* name) const {
        std::ifstream in(path / name, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
};

struct Result {
    int code = -1;
    std::string out, err;
};

/// Runs `mane` with arguments as a shell takes them, in the folder.
inline Result mane_command(const Folder& folder, const std::string& arguments) {
    const std::string command = "cd '" + folder.path.string() + "' && '" MANE_COMMAND "' " +
                                arguments + " >out.txt 2>err.txt";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, folder.read("out.txt"),
            folder.read("err.txt")};
}
