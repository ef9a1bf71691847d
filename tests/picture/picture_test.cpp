#include "mane/picture.h"

#include "mane/body.h"
#include "mane/error.h"
#include "picture/camera.h"
#include "picture/glyphs.h"

#include <cmath>
#include <cstdio>
#include <doctest/doctest.h>
#include <filesystem>
#include <png.h>
#include <unistd.h>

using namespace mane;

namespace {

struct Hair {
    Groom groom;
    Frame frame;
    StrandDesc strands;
    Mesh body{{{-0.1f, -0.1f, 0}, {0.1f, -0.1f, 0}, {0.1f, 0.1f, 0}, {-0.1f, 0.1f, 0}},
              {{0, 1, 2}, {0, 2, 3}}};
    PictureBody bodies[1] = {{body.vertices, body.triangles}};
    HeadPose head;

    // A wisp that hangs before a square board which faces +Z, the whole at (5, 6, 7).
    Hair() {
        groom.first_section = {0, 6};
        groom.roots.resize(1);
        groom.strands = {1};
        for (int i = 0; i < 6; ++i) {
            groom.position.push_back({0, 0.1f - 0.04f * static_cast<float>(i), 0.03f});
            groom.radius.insert(groom.radius.end(), 4, 0.015f);
        }
        frame.position = groom.position;
        frame.radius = groom.radius;
        frame.first_axis = {{1, 0, 0}};
        frame.origin = head.centre = {5, 6, 7};
        strands.count = 3000;
    }
    Image picture(PictureDesc desc) const {
        desc.width = desc.height = 48;
        desc.samples = 4;
        desc.strands = 1000;
        desc.frame_height = 0.4;
        return render(groom, frame, strands, 1, bodies, head, desc);
    }
};

int differing(const Image& a, const Image& b) {
    int count = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i)
        count += a.pixels[i] != b.pixels[i];
    return count;
}

} // namespace

TEST_CASE(
    "camera: each view stands where its name says, also of a head that is turned or upside-down") {
    const double quarter = std::sqrt(0.5);
    const auto eye = [](View view, const Quatd& rotation) {
        const Camera c = camera_for(view, {{1, 2, 3}, rotation}, 0.5);
        const Vec3d d = c.eye - Vec3d{1, 2, 3};
        return normalized(Vec3d{d.x, 0, d.z});
    };
    CHECK(length(eye(View::face, {}) - Vec3d{0, 0, 1}) < 1e-9);
    CHECK(length(eye(View::profile, {}) - Vec3d{1, 0, 0}) < 1e-9);
    CHECK(length(eye(View::back, {}) - Vec3d{0, 0, -1}) < 1e-9);
    CHECK(length(eye(View::face, {0, quarter, 0, quarter}) - Vec3d{1, 0, 0}) < 1e-9); // turned left
    CHECK(length(eye(View::face, {quarter, 0, 0, quarter}) - Vec3d{0, 0, 1}) < 1e-9); // looks down
    CHECK(length(eye(View::face, {-quarter, 0, 0, quarter}) - Vec3d{0, 0, 1}) < 1e-9); // looks up
    CHECK(camera_for(View::face, {}, 0.5).up == Vec3d{0, 1, 0});
}

TEST_CASE("camera: a preset sees its height, the target in the middle") {
    const Camera camera = camera_for(View::face, {{5, 6, 7}, {}}, 0.5);
    const Lens lens(camera, {5, 6, 7}, 64, 32);
    CHECK(length(Vec3d(lens.direction(32, 16)) - normalized(camera.target - camera.eye)) < 1e-6);
    const double distance = length(camera.target - camera.eye);
    const Vec3 upper = lens.direction(32, 0);
    const double angle = std::acos(double{dot(upper, lens.direction(32, 16))});
    CHECK(std::tan(angle) * distance == doctest::Approx(0.25).epsilon(0.01));
    CHECK(dot(upper, lens.up()) > 0);
}

TEST_CASE("picture: the same pixels for any number of threads") {
    const Hair hair;
    CHECK(differing(hair.picture({.threads = 1}), hair.picture({.threads = 3})) == 0);
}

TEST_CASE("picture: each layer draws itself over the body, the body over the background") {
    const Hair hair;
    Image none = hair.picture({.layer = PictureLayer::character, .view = View::face});
    const int body_pixels = [&] {
        Hair bare;
        bare.body.vertices.assign(4, {});
        bare.bodies[0] = {bare.body.vertices, bare.body.triangles};
        return differing(none,
                         bare.picture({.layer = PictureLayer::character, .view = View::face}));
    }();
    // 0.2 of 0.4 m each way: a quarter of 48²; its border, and the camera's small height above it.
    CHECK(body_pixels == doctest::Approx(24 * 24).epsilon(0.2));
    for (const PictureLayer layer :
         {PictureLayer::strands, PictureLayer::skeleton, PictureLayer::envelope})
        CHECK(differing(none, hair.picture({.layer = layer, .view = View::face})) > 20);
}

TEST_CASE("picture: what cannot be drawn is said") {
    const Hair hair;
    CHECK_THROWS_WITH_AS(
        render(hair.groom, hair.frame, hair.strands, 1, hair.bodies, hair.head, {.samples = 0}),
        "a picture needs at least 1 pixel and 1 sample, found 640 × 640 pixels, 0 samples",
        InputError);
}

TEST_CASE("contact sheet: images in rows, labels above, one size only") {
    const auto plain = [](std::uint8_t grey) {
        return Image{20, 10, std::vector<std::array<std::uint8_t, 3>>(200, {grey, grey, grey})};
    };
    const std::vector<Image> images{plain(10), plain(20), plain(30)};
    const std::vector<std::string> none, labels{"L"};
    const Image sheet = contact_sheet(images, none, 2);
    CHECK(sheet.width == 2 * 20 + 3 * 4);
    CHECK(sheet.height == 2 * 10 + 3 * 4);
    CHECK(sheet.pixels[4 * sheet.width + 4][0] == 10);
    CHECK(sheet.pixels[4 * sheet.width + 28][0] == 20);
    CHECK(sheet.pixels[18 * sheet.width + 4][0] == 30);
    CHECK(sheet.pixels[18 * sheet.width + 28][0] == 250);

    const Image labelled = contact_sheet(images, labels, 2);
    int ink = 0;
    for (const auto& p : labelled.pixels)
        ink += p[0] == 30 && p[1] == 30 && p[2] == 30;
    CHECK(ink - 200 == 4 * (6 + 5)); // the third image's pixels, and an L of 6 + 5 squares of four
    CHECK(glyph('a') == glyph('A'));

    const std::vector<Image> odd{plain(1),
                                 Image{3, 3, std::vector<std::array<std::uint8_t, 3>>(9)}};
    CHECK_THROWS_AS(contact_sheet(odd, none, 2), InputError);
}

TEST_CASE("PNG: read back as written, by libpng") {
    const auto path =
        std::filesystem::temp_directory_path() / ("mane_" + std::to_string(getpid()) + ".png");
    Image image{3, 2, {}};
    for (int i = 0; i < 6; ++i)
        image.pixels.push_back({static_cast<std::uint8_t>(40 * i), 7, 255});
    write_png(image, path);
    png_image header{};
    header.version = PNG_IMAGE_VERSION;
    REQUIRE(png_image_begin_read_from_file(&header, path.c_str()));
    header.format = PNG_FORMAT_RGB;
    CHECK(header.width == 3);
    CHECK(header.height == 2);
    std::vector<std::array<std::uint8_t, 3>> read(6);
    REQUIRE(png_image_finish_read(&header, nullptr, read.data(), 0, nullptr));
    CHECK(read == image.pixels);
    std::filesystem::remove(path);
    CHECK_THROWS_WITH_AS(write_png(image, "/no/such/folder/a.png"),
                         "cannot write /no/such/folder/a.png: No such file or directory",
                         InputError);
}
