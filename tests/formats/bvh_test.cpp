#include "clip_data.h"

#include "mane/error.h"
#include "mane/import.h"

using namespace mane;

namespace {

const std::string kHierarchy =
    "HIERARCHY\n"
    "ROOT Hips\n"
    "{\n"
    "  OFFSET 1 2 3\n"
    "  CHANNELS 6 Xposition Yposition Zposition Yrotation Xrotation Zrotation\n"
    "  JOINT Head\n"
    "  {\n"
    "    OFFSET 0 10 0\n"
    "    CHANNELS 2 Zrotation Xrotation\n"
    "    End Site\n"
    "    {\n"
    "      OFFSET 0 5 0\n"
    "    }\n"
    "  }\n"
    "}\n"; // 15 lines
const std::string kMotion =
    "MOTION\nFrames: 2\nFrame Time: .0083333\n1 2 3 4 5 6 7 8\n-1 -2 -3 -4 -5 -6 -7 -8\n";

Clip clip_of(const std::string& text) {
    const TextFile file("clip.bvh", text);
    return read_bvh(file.path());
}

std::string error_of(const std::string& text) {
    const TextFile file("bad.bvh", text);
    try {
        read_bvh(file.path());
    } catch (const InputError& e) {
        return std::string(e.what()).substr(file.path().size());
    }
    return "no error";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
}

void expect(const std::string& error, const std::string& start) {
    CHECK(error.substr(0, start.size()) == start);
}

} // namespace

TEST_CASE("a BVH file's hierarchy, channels and frames") {
    const Clip clip = clip_of(kHierarchy + kMotion);
    REQUIRE(clip.joints.size() == 3);
    CHECK(clip.joints[0].name == "Hips");
    CHECK(clip.joints[0].parent == -1);
    CHECK(clip.joints[0].offset == Vec3d(1, 2, 3));
    CHECK(clip.joints[0].channels[3] == Clip::Channel::y_rotation);
    CHECK(clip.joints[1].parent == 0);
    CHECK(clip.joints[1].first_channel == 6);
    CHECK(clip.joints[1].channels ==
          std::vector{Clip::Channel::z_rotation, Clip::Channel::x_rotation});
    CHECK(clip.joints[2].name.empty());
    CHECK(clip.joints[2].parent == 1);
    CHECK(clip.joints[2].offset == Vec3d(0, 5, 0));
    CHECK(clip.channel_count == 8);
    CHECK(clip.frame_count == 2);
    CHECK(clip.frame_time == 0.0083333);
    CHECK(clip.frame(1)[7] == -8);
}

TEST_CASE("BVH line ends, blank lines and several roots do not matter") {
    const std::string text = kHierarchy + replaced(kHierarchy, "HIERARCHY\n", "") +
                             "MOTION\n\nFrames:\t1\nFrame Time: 1\n\n" +
                             "1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 \n\n\n";
    std::string dos;
    for (char c : text) {
        if (c == '\n')
            dos += '\r';
        dos += c;
    }
    const Clip clip = clip_of(dos);
    CHECK(clip.joints.size() == 6);
    CHECK(clip.joints[3].parent == -1);
    CHECK(clip.frame(0)[15] == 16);
}

TEST_CASE("a bad BVH file is refused with its line, what was found and what was expected") {
    const std::string good = kHierarchy + kMotion;
    expect(error_of(""), ":0: the file ends");
    expect(error_of("v 0 0 0\n"), ":1: \"v\", expected HIERARCHY");
    expect(error_of(kHierarchy.substr(0, kHierarchy.find("Zrotation Xrotation\n    End"))),
           ":9: the file ends where a channel was expected");
    expect(error_of(kHierarchy.substr(0, kHierarchy.find("End Site"))),
           ":10: the file ends where } of joint Head");
    expect(error_of(kHierarchy), ":15: the file ends where ROOT or MOTION");
    expect(error_of(replaced(good, "OFFSET 0 10 0", "OFFSET 0 10")),
           ":9: \"CHANNELS\", expected an offset");
    expect(error_of(replaced(good, "OFFSET 0 10 0", "OFFSET 0 inf 0")),
           ":8: \"inf\", expected an offset");
    expect(error_of(replaced(good, "CHANNELS 2", "CHANNELS 3")), ":10: channel \"End\"");
    expect(error_of(replaced(good, "CHANNELS 2", "CHANNELS 7")), ":9: 7 channels");
    expect(error_of(replaced(good, "CHANNELS 2 Z", "CHANNELS 2 W")), ":9: channel \"Wrotation\"");
    expect(error_of(replaced(good, "Frames: 2", "Frames: two")),
           ":17: \"two\", expected the number of frames");
    expect(error_of(replaced(good, "Frames: 2", "Frames: 0")), ":17: no frames");
    expect(error_of(replaced(good, "Frames: 2", "Frames: 3")),
           ":20: the file ends after 2 of 3 frames");
    expect(error_of(replaced(good, "Frames: 2", "Frames: 1")),
           ":20: more frames than the 1 announced");
    expect(error_of(replaced(good, ".0083333", "0")), ":18: frame time 0");
    expect(error_of(replaced(good, "-4", "nan")), ":20: frame 1, value 4 is \"nan\"");
    expect(error_of(replaced(good, "-4", "-inf")), ":20: frame 1, value 4 is \"-inf\"");
    expect(error_of(replaced(good, "-4", "4,5")), ":20: frame 1, value 4 is \"4,5\"");
    expect(error_of(replaced(good, " -8", "")), ":20: frame 1 has 7 values, expected 8");
    expect(error_of(replaced(good, " -8", " -8 -9")), ":20: frame 1 has 9 values, expected 8");
    expect(error_of("HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\n}\nMOTION\n"),
           ":6: MOTION, but no joint has a channel");
    std::string deep = "HIERARCHY\nROOT a {\n";
    for (int k = 0; k < 1000; ++k)
        deep += "JOINT a {\n";
    expect(error_of(deep), ":202: hierarchy deeper than 200");
    CHECK_THROWS_WITH_AS(read_bvh("no/such.bvh"),
                         "no/such.bvh: cannot be opened; expected a readable file", InputError);
}
