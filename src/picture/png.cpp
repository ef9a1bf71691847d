#include "mane/error.h"
#include "mane/picture.h"

#include <png.h>

#include <cerrno>
#include <cstring>

namespace mane {

void write_png(const Image& image, const std::filesystem::path& path) {
    std::filesystem::path beside = path;
    beside += ".part";
    const auto fail = [&](const std::string& reason) {
        std::error_code ignored;
        std::filesystem::remove(beside, ignored);
        throw InputError("cannot write " + path.string() + ": " + reason);
    };
    png_image header{};
    header.version = PNG_IMAGE_VERSION;
    header.width = image.width;
    header.height = image.height;
    header.format = PNG_FORMAT_RGB;
    errno = 0;
    if (!png_image_write_to_file(&header, beside.c_str(), 0, image.pixels.data(), 0, nullptr))
        fail(errno ? std::strerror(errno) : header.message);
    std::error_code error;
    std::filesystem::rename(beside, path, error);
    if (error)
        fail(error.message());
}

} // namespace mane
