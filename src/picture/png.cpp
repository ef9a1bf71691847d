#include "base/whole_file.h"
#include "mane/error.h"
#include "mane/picture.h"

#include <png.h>

namespace mane {

void write_png(const Image& image, const std::filesystem::path& path) {
    png_image header{};
    header.version = PNG_IMAGE_VERSION;
    header.width = image.width;
    header.height = image.height;
    header.format = PNG_FORMAT_RGB;
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(header);
    std::vector<std::uint8_t> bytes(size);
    if (!png_image_write_to_memory(&header, bytes.data(), &size, 0, image.pixels.data(), 0,
                                   nullptr))
        throw InputError("cannot write " + path.string() + ": " + header.message);
    WholeFile file(path);
    file.write(bytes.data(), size);
    file.finish();
}

} // namespace mane
