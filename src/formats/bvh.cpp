#include "mane/error.h"
#include "mane/import.h"

#include "formats/text.h"

#include <cmath>

namespace mane {
namespace {

struct ChannelName {
    std::string_view name;
    Clip::Channel channel;
};
constexpr ChannelName kChannels[] = {
    {"Xposition", Clip::Channel::x_position}, {"Yposition", Clip::Channel::y_position},
    {"Zposition", Clip::Channel::z_position}, {"Xrotation", Clip::Channel::x_rotation},
    {"Yrotation", Clip::Channel::y_rotation}, {"Zrotation", Clip::Channel::z_rotation},
};

// One BVH file being read: the hierarchy word by word, the motion line by line (one frame a line),
// so that a missing number is reported in its own frame and not at the end of the file.
class BvhReader {
  public:
    explicit BvhReader(const std::string& path)
        : path_(path), text_(read_text(path)), lines_(text_) {}

    Clip read() {
        clip_.source = path_;
        expect("HIERARCHY", "the file's first word");
        std::string word = take("ROOT or MOTION");
        for (; word == "ROOT"; word = take("ROOT or MOTION"))
            read_joint(-1, take("a joint's name"));
        if (word != "MOTION")
            fail("\"" + word + "\", expected ROOT or MOTION");
        if (clip_.channel_count == 0)
            fail("MOTION, but no joint has a channel");
        read_frame_header();
        read_frames();
        return std::move(clip_);
    }

  private:
    // An opened joint's body, up to its closing brace.
    void read_joint(std::int32_t parent, std::string name) {
        if (depth_ == kDeepest)
            fail("hierarchy deeper than " + std::to_string(kDeepest));
        ++depth_;
        const auto index = static_cast<std::int32_t>(clip_.joints.size());
        clip_.joints.emplace_back();
        joint(index).name = std::move(name);
        joint(index).parent = parent;
        joint(index).first_channel = clip_.channel_count;
        expect("{", "a joint's body");
        for (std::string word = take_in_joint(index); word != "}"; word = take_in_joint(index)) {
            if (word == "OFFSET")
                joint(index).offset = read_offset();
            else if (word == "CHANNELS")
                read_channels(index);
            else if (word == "JOINT")
                read_joint(index, take("a joint's name"));
            else if (word == "End")
                read_end_site(index);
            else
                fail("\"" + word + "\", expected OFFSET, CHANNELS, JOINT, End Site or }");
        }
        --depth_;
    }

    void read_end_site(std::int32_t parent) {
        expect("Site", "the second word of End Site");
        read_joint(parent, "");
    }

    Vec3d read_offset() {
        Vec3d offset;
        offset.x = take_finite("an offset");
        offset.y = take_finite("an offset");
        offset.z = take_finite("an offset");
        return offset;
    }

    void read_channels(std::int32_t index) {
        if (!joint(index).channels.empty())
            fail("second CHANNELS of the same joint");
        const long long count = take_count("the number of channels");
        if (count > 6)
            fail(std::to_string(count) + " channels, expected at most 6");
        joint(index).first_channel = clip_.channel_count;
        for (long long c = 0; c < count; ++c)
            joint(index).channels.push_back(channel_named(take("a channel")));
        clip_.channel_count += static_cast<std::uint32_t>(count);
    }

    Clip::Channel channel_named(const std::string& word) {
        for (const ChannelName& c : kChannels)
            if (word == c.name)
                return c.channel;
        fail("channel \"" + word + "\", expected Xposition … Zrotation");
    }

    void read_frame_header() {
        expect("Frames:", "the number of frames");
        clip_.frame_count = static_cast<std::uint32_t>(take_count("the number of frames"));
        if (clip_.frame_count == 0)
            fail("no frames");
        expect("Frame", "the frame time");
        expect("Time:", "the frame time");
        clip_.frame_time = take_finite("the frame time");
        if (!(clip_.frame_time > 0))
            fail("frame time " + std::to_string(clip_.frame_time) + " s, expected more than 0");
        if (!take_word(line_.text).empty())
            fail("words after the frame time");
    }

    void read_frames() {
        // The count is the file's claim: memory follows what is really there.
        for (std::uint32_t frame = 0; next_filled_line(); ++frame) {
            if (frame == clip_.frame_count)
                fail("more frames than the " + std::to_string(frame) + " announced");
            read_frame(frame);
        }
        const std::size_t found = clip_.values.size() / clip_.channel_count;
        if (found < clip_.frame_count)
            fail("the file ends after " + std::to_string(found) + " of " +
                 std::to_string(clip_.frame_count) + " frames; is it truncated?");
    }

    void read_frame(std::uint32_t frame) {
        std::uint32_t count = 0;
        for (auto word = take_word(line_.text); !word.empty(); word = take_word(line_.text)) {
            double value = 0;
            if (!parse_number(word, value) || !std::isfinite(value))
                fail("frame " + std::to_string(frame) + ", value " + std::to_string(count + 1) +
                     " is \"" + std::string(word) + "\", expected a finite number");
            clip_.values.push_back(value);
            ++count;
        }
        if (count != clip_.channel_count)
            fail("frame " + std::to_string(frame) + " has " + std::to_string(count) +
                 " values, expected " + std::to_string(clip_.channel_count) + ", one per channel");
    }

    bool next_filled_line() {
        while (lines_.next(line_))
            if (line_.text.find_first_not_of(" \t\r") != std::string_view::npos)
                return true;
        return false;
    }

    // The next word, over the ends of lines.
    std::string take(const char* expected) {
        for (;;) {
            const std::string_view word = take_word(line_.text);
            if (!word.empty())
                return std::string(word);
            if (!lines_.next(line_))
                fail(std::string("the file ends where ") + expected +
                     " was expected; is it truncated?");
        }
    }
    std::string take_in_joint(std::int32_t index) {
        const std::string& name = joint(index).name;
        const std::string expected = "} of " + (name.empty() ? "an End Site" : "joint " + name);
        return take(expected.c_str());
    }
    void expect(std::string_view word, const char* what) {
        const std::string found = take(what);
        if (found != word)
            fail("\"" + found + "\", expected " + std::string(word) + " (" + what + ")");
    }
    double take_finite(const char* what) {
        const std::string word = take(what);
        double number = 0;
        if (!parse_number(word, number) || !std::isfinite(number))
            fail("\"" + word + "\", expected " + what + " as a finite number");
        return number;
    }
    long long take_count(const char* what) {
        const std::string word = take(what);
        long long number = 0;
        if (!parse_number(word, number) || number < 0 || number > 1'000'000'000)
            fail("\"" + word + "\", expected " + what);
        return number;
    }

    Clip::Joint& joint(std::int32_t index) { return clip_.joints[static_cast<std::size_t>(index)]; }
    [[noreturn]] void fail(const std::string& what) const { fail_at(path_, lines_.number(), what); }

    static constexpr int kDeepest =
        200; // joints inside joints: recursion stays small on hostile files

    const std::string& path_;
    std::string text_;
    LineReader lines_;
    Line line_;
    Clip clip_;
    int depth_ = 0;
};

} // namespace

Clip read_bvh(const std::string& path) {
    return BvhReader(path).read();
}

} // namespace mane
