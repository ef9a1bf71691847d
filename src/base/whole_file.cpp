#include "base/whole_file.h"

#include "mane/error.h"

#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>

namespace mane {

WholeFile::WholeFile(std::filesystem::path path) : path_(std::move(path)), part_(path_) {
    std::error_code ignored;
    if (!std::filesystem::exists(path_, ignored) ||
        std::filesystem::is_regular_file(path_, ignored))
        part_ += ".part";
    file_ = std::fopen(part_.string().c_str(), "wb");
    if (!file_)
        fail(std::strerror(errno));
}

WholeFile::~WholeFile() {
    if (!file_)
        return;
    std::fclose(file_);
    std::error_code ignored;
    if (part_ != path_)
        std::filesystem::remove(part_, ignored);
}

void WholeFile::write(const void* data, std::size_t size) {
    if (std::fwrite(data, 1, size, file_) != size)
        fail(std::strerror(errno));
}

void WholeFile::finish() {
    // The last bytes meet a full disk here, and not in `write`.
    if (std::fflush(file_) != 0)
        fail(std::strerror(errno));
    std::fclose(std::exchange(file_, nullptr));
    if (part_ == path_)
        return;
    std::error_code error;
    std::filesystem::rename(part_, path_, error);
    if (error)
        fail(error.message());
}

void WholeFile::fail(const std::string& reason) const {
    throw InputError("cannot write " + path_.string() + ": " + reason);
}

} // namespace mane
