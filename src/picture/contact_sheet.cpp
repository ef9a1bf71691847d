#include "mane/error.h"
#include "mane/picture.h"
#include "picture/glyphs.h"

#include <algorithm>

namespace mane {
namespace {

constexpr std::uint32_t kGap = 4;        // [pixels] between images
constexpr std::uint32_t kLetterSize = 2; // [pixels] of a glyph's pixel
constexpr std::uint32_t kBand = kGlyphHeight * kLetterSize + 2 * kGap;
constexpr std::array<std::uint8_t, 3> kPaper{250, 250, 250}, kInk{30, 30, 30};

void print(Image& sheet, const std::string& text, std::uint32_t x, std::uint32_t y,
           std::uint32_t width) {
    constexpr std::uint32_t advance = (kGlyphWidth + 1) * kLetterSize;
    for (std::size_t n = 0; n < text.size() && (n + 1) * advance <= width; ++n, x += advance) {
        const auto rows = glyph(text[n]);
        for (std::uint32_t j = 0; j < kGlyphHeight * kLetterSize; ++j)
            for (std::uint32_t i = 0; i < kGlyphWidth * kLetterSize; ++i)
                if (rows[j / kLetterSize] >> (kGlyphWidth - 1 - static_cast<int>(i / kLetterSize)) &
                    1)
                    sheet.pixels[std::size_t{y + j} * sheet.width + x + i] = kInk;
    }
}

} // namespace

Image contact_sheet(std::span<const Image> images, std::span<const std::string> labels,
                    std::uint32_t columns) {
    if (images.empty() || columns == 0)
        throw InputError("a contact sheet needs at least 1 image and 1 column");
    const std::uint32_t width = images[0].width, height = images[0].height;
    for (const Image& image : images)
        if (image.width != width || image.height != height)
            throw InputError("a contact sheet's images must have one size, found " +
                             std::to_string(image.width) + " × " + std::to_string(image.height) +
                             " beside " + std::to_string(width) + " × " + std::to_string(height));
    const bool labelled =
        std::any_of(labels.begin(), labels.end(), [](const std::string& l) { return !l.empty(); });
    const auto count = static_cast<std::uint32_t>(images.size());
    const std::uint32_t band = labelled ? kBand : 0, rows = (count + columns - 1) / columns;

    Image sheet{columns * (width + kGap) + kGap, rows * (height + band + kGap) + kGap, {}};
    sheet.pixels.assign(std::size_t{sheet.width} * sheet.height, kPaper);
    for (std::uint32_t n = 0; n < count; ++n) {
        const std::uint32_t x = kGap + n % columns * (width + kGap),
                            y = kGap + n / columns * (height + band + kGap);
        if (n < labels.size())
            print(sheet, labels[n], x, y + kGap, width);
        for (std::uint32_t j = 0; j < height; ++j)
            std::copy_n(images[n].pixels.begin() + std::size_t{j} * width, width,
                        sheet.pixels.begin() + std::size_t{y + band + j} * sheet.width + x);
    }
    return sheet;
}

} // namespace mane
