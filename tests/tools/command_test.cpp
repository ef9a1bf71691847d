#include "command.h"

#include "mane/cache.h"
#include "mane/error.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <sstream>
#include <string>
#include <thread>

#include <sys/wait.h>
#include <unistd.h>

using namespace mane;
namespace fs = std::filesystem;

namespace {

/// Frames that a growing file holds; none while its head is not yet written.
std::size_t frames_in(const std::string& file) {
    try {
        return CacheReader(file).frame_count();
    } catch (const InputError&) {
        return 0;
    }
}

/// Bad input: exit code 2, one line that begins with "mane: ", nothing else.
void check_bad(const Folder& folder, const std::string& arguments, const std::string& message) {
    CAPTURE(arguments);
    const Result r = mane_command(folder, arguments);
    CHECK(r.code == 2);
    CHECK(r.err == "mane: " + message + "\n");
    CHECK(r.out.empty());
    CHECK_FALSE(fs::exists(folder / "out.mane"));
    CHECK_FALSE(fs::exists(folder / "out.mane.part"));
}

} // namespace

TEST_CASE("help and version are there") {
    Folder folder;
    CHECK(mane_command(folder, "--version").out.starts_with("mane 0."));
    const Result help = mane_command(folder, "--help");
    CHECK(help.code == 0);
    for (const char* word :
         {"simulate", "info", "check", "compare", "help", "Examples:", "Exit codes:"})
        CHECK(help.out.find(word) != std::string::npos);
    CHECK(mane_command(folder, "simulate --help").out.find("--rates") != std::string::npos);
    CHECK(mane_command(folder, "help scene").out.find("bending_length") != std::string::npos);
    const Result section = mane_command(folder, "help scene air");
    CHECK(section.out.find("gust_size") != std::string::npos);
    CHECK(section.out.find("bending_length") == std::string::npos);
    CHECK(nlohmann::json::parse(mane_command(folder, "help scene --schema").out)
              .contains("properties"));
}

TEST_CASE("bad input is one clear message and exit code 2") {
    Folder folder;
    folder.write("key.toml", "[skeleton]\nstrian = 0.01\n");
    folder.write("type.toml", "[skeleton]\nstrain = \"soft\"\n");
    folder.write("unit.toml", "[skeleton]\nbending_length = \"6 kg\"\n");
    folder.write("syntax.toml", "[skeleton\n");
    check_bad(folder, "simulate key.toml -o out.mane",
              "key.toml:2: unknown key skeleton.strian (did you mean skeleton.strain?)");
    check_bad(folder, "simulate type.toml -o out.mane",
              "type.toml:2: skeleton.strain: found \"soft\", expected a number from 0.0001 to 0.2");
    check_bad(folder, "simulate unit.toml -o out.mane",
              "unit.toml:2: skeleton.bending_length: found \"6 kg\", expected a number from 0 to 1 "
              "[m]: \"kg\" is no unit for [m]");
    check_bad(folder, "simulate none.toml -o out.mane", "none.toml: cannot be read");
    check_bad(folder, "simulate small.toml -o out.mane --set air.darg=1",
              "--set air.darg=1: unknown key air.darg (did you mean air.drag?)");
    check_bad(folder, "simulate small.toml -o out.mane --frames 0",
              "--set schedule.frames=0: schedule.frames: found 0, expected a whole number from 1 "
              "to 1000000");
    check_bad(folder, "simulate small.toml -o out.mane --rates fast",
              "rates \"fast\": expected one of default, paper, fine, paper-literal");
    check_bad(folder, "help scene hair",
              "help scene: there is no section [hair]; `mane help scene` shows all");
    CHECK(mane_command(folder, "simulate syntax.toml -o out.mane")
              .err.starts_with("mane: syntax.toml:1: "));

    for (const char* arguments :
         {"", "dance", "simulate", "simulate small.toml", "compare a.mane", "info --what a.mane"}) {
        const Result r = mane_command(folder, arguments);
        CAPTURE(arguments);
        CHECK(r.code == 2);
        CHECK(r.err.starts_with("mane: "));
        CHECK(r.err.find("`mane --help` shows how\n") != std::string::npos);
    }
}

TEST_CASE("a place that cannot be written is said before the run") {
    Folder folder;
    check_bad(folder, "simulate small.toml -o no/where.mane",
              "no/where.mane: cannot be written: No such file or directory");
    if (fs::exists("/dev/full"))
        check_bad(folder, "simulate small.toml -o /dev/full",
                  "/dev/full: cannot be written: No space left on device");
    else
        MESSAGE("skipped: /dev/full missing");
}

TEST_CASE("a disk that fills up during a run leaves the frames so far in FILE.part") {
    Folder folder;
    // 200 blocks of 512 bytes: the limit on a file's size stands for the disk's.
    const std::string limited = "cd '" + folder.path.string() +
                                "' && trap '' XFSZ && ulimit -f 200 && '" MANE_COMMAND
                                "' simulate small.toml -o a.mane --frames 100000 2>err.txt";
    const int status = std::system(limited.c_str());
    CHECK(WEXITSTATUS(status) == 2);
    CHECK_FALSE(fs::exists(folder / "a.mane"));
    const std::size_t frames = frames_in(folder / "a.mane.part");
    CHECK(frames > 0);
    CHECK(folder.read("err.txt") == "mane: a.mane: cannot be written: File too large; " +
                                        std::to_string(frames) + " frames are in a.mane.part\n");
}

TEST_CASE("meshes with open edges are used with a warning that counts them") {
    Folder folder;
    folder.write("flag.obj", "v 0 3 0\nv 1 3 0\nv 0 4 0\nf 1 2 3\n");
    folder.write("flag.toml", folder.read("small.toml") +
                                  "[[obstacle]]\nshape = \"mesh\"\nmesh = \"flag.obj\"\n");
    const Result r = mane_command(folder, "simulate flag.toml -o a.mane");
    CHECK(r.code == 0);
    CHECK(r.err == "mane: warning: flag.obj: 3 open edges\n");
    CHECK(CacheReader(folder / "a.mane").setup().bodies.size() == 2);
    folder.write("none.toml", "[character]\nmesh = \"none.obj\"\n");
    const Result none = mane_command(folder, "simulate none.toml -o b.mane");
    CHECK(none.code == 2);
    CHECK(none.err.starts_with("mane: none.obj"));
}

TEST_CASE("a run leaves a cache, a table and statistics; info and compare read it") {
    Folder folder;
    const Result run =
        mane_command(folder, "simulate small.toml -o a.mane --stats a.json --record");
    CHECK(run.err.empty()); // no progress bar where there is no terminal
    REQUIRE(run.code == 0);
    CHECK(run.out.find("intersections per segment") != std::string::npos);
    CHECK(run.out.find("12.8") != std::string::npos);

    const auto statistics = nlohmann::json::parse(folder.read("a.json"));
    for (const char* key : {"stages", "real_time_ratio", "wisps", "segments_per_wisp",
                            "intersections_per_segment", "contacts", "state_hash"})
        CHECK(statistics.contains(key));
    CHECK(statistics["wisps"] == 8);
    CHECK(statistics["frames"] == 4);

    const CacheReader cache(folder / "a.mane");
    CHECK(cache.damage().empty());
    REQUIRE(cache.frame_count() == 4);
    CHECK(cache.frame(3).index == 3);
    CHECK(cache.frame(0).time == doctest::Approx(0));
    CHECK(cache.frame(3).time == doctest::Approx(3 / 24.0));
    CHECK_FALSE(cache.table("PROF", 2).empty());
    const std::vector<Column> contacts = cache.table("CONT", 3);
    REQUIRE(contacts.size() == 10);
    CHECK(contacts[0].name == "kind");
    CHECK_FALSE(std::get<std::vector<std::uint32_t>>(contacts[0].values).empty());

    const auto info = nlohmann::json::parse(mane_command(folder, "info a.mane --json").out);
    CHECK(info["frames"] == 4);
    CHECK(info["whole"] == true);
    CHECK(info["statistics"]["state_hash"] == statistics["state_hash"]);
    CHECK(mane_command(folder, "info a.mane").out.find("8 wisps") != std::string::npos);

    REQUIRE(mane_command(folder, "simulate small.toml -o b.mane --threads 2").code == 0);
    CHECK(mane_command(folder, "compare a.mane b.mane").code == 0);
    REQUIRE(mane_command(folder, "simulate small.toml -o b.mane --instruction-set scalar").code ==
            0);
    CHECK(mane_command(folder, "compare a.mane b.mane").code == 0);
    REQUIRE(mane_command(folder, "simulate small.toml -o c.mane --set air.wind=[2,0,0]").code == 0);
    const Result different = mane_command(folder, "compare a.mane c.mane --json");
    CHECK(different.code == 1);
    const auto comparison = nlohmann::json::parse(different.out);
    CHECK(comparison["same"] == false);
    CHECK(comparison["first_frame"] == 1); // frame 0 is the groom as designed in both
    CHECK(comparison["layers"]["skeleton"]["largest"].get<double>() > 1e-6);
    CHECK(comparison["layers"]["character"]["largest"] == 0.0);
    CHECK(mane_command(folder, "compare a.mane c.mane --tolerance 100").code == 0);
    REQUIRE(mane_command(folder, "simulate small.toml -o d.mane --frames 2").code == 0);
    CHECK(mane_command(folder, "compare a.mane d.mane")
              .out.find("different: 4 frames, the other 2") != std::string::npos);
}

TEST_CASE("check judges a run, in a table and as JSON, and its exit code is the verdict") {
    Folder folder;
    REQUIRE(mane_command(folder, "simulate small.toml -o a.mane").code == 0);
    const Result good = mane_command(folder, "check a.mane");
    CHECK(good.code == 0);
    CHECK(good.out.find("skeleton_inside") != std::string::npos);
    CHECK(good.out.ends_with("\npass\n"));

    REQUIRE(mane_command(folder, "simulate small.toml -o b.mane --set check.area=1").code == 0);
    const Result bad = mane_command(folder, "check b.mane --json");
    CHECK(bad.code == 1);
    const auto report = nlohmann::json::parse(bad.out);
    CHECK(report["passed"] == false);
    for (const auto& criterion : report["criteria"])
        CHECK((criterion["verdict"] == "fail") == (criterion["name"] == "area"));
    CHECK(mane_command(folder, "check b.mane").out.find("\nFAIL: 1 of ") != std::string::npos);
    check_bad(folder, "check none.mane", "none.mane: cannot be read");
    check_bad(
        folder, "simulate small.toml -o out.mane --set check.stretch=0.2",
        "--set check.stretch=0.2: check.stretch: found 0.2, expected a number from 0 to 0.15");
}

TEST_CASE("a scene's settings are stored with the run") {
    Folder folder;
    REQUIRE(mane_command(folder, "simulate small.toml -o a.mane --frames 1 --rates paper --set "
                                 "skeleton.strain=0.01 --set air.drag=4")
                .code == 0);
    const CacheReader cache(folder / "a.mane");
    const std::string& scene = cache.setup().scene;
    CHECK(scene.find("strain = 0.01\n") != std::string::npos);
    CHECK(scene.find("drag = 4.0\n") != std::string::npos);
    CHECK(scene.find("wisp_rate = 24.0\n") != std::string::npos);
}

TEST_CASE("damaged caches are refused with the place, cut ones are read as far as they go") {
    Folder folder;
    REQUIRE(mane_command(folder, "simulate small.toml -o a.mane").code == 0);
    const std::string bytes = folder.read("a.mane");
    std::uint64_t second_frame = 0;
    {
        const CacheReader cache(folder / "a.mane");
        for (const ChunkInfo& chunk : cache.chunks())
            if (chunk.type == "FRAM" && chunk.number == 1)
                second_frame = chunk.offset;
    }
    folder.write("cut.mane", bytes.substr(0, second_frame + 60));
    const Result cut = mane_command(folder, "info cut.mane");
    CHECK(cut.code == 0);
    CHECK(cut.out.find("not whole: no index: the run was interrupted; no whole chunk at byte " +
                       std::to_string(second_frame)) != std::string::npos);
    CHECK(cut.out.find("  1 frames") != std::string::npos);

    std::string flipped = bytes;
    flipped[second_frame + 60] ^= 1;
    folder.write("flipped.mane", flipped);
    check_bad(folder, "info flipped.mane",
              "flipped.mane: chunk FRAM 1 at byte " + std::to_string(second_frame) +
                  ": checksum mismatch");
    folder.write("head.mane", bytes.substr(0, 30));
    check_bad(folder, "info head.mane",
              "head.mane: is truncated: there is no whole chunk SCEN (no index: the run was "
              "interrupted; no whole chunk at byte 16)");
    check_bad(folder, "info small.toml", "small.toml: is no .mane file (bad magic)");
    check_bad(folder, "compare a.mane none.mane", "none.mane: cannot be read");
}

TEST_CASE("a page is written that holds the run; without its pages the command says so") {
    const Folder folder;
    REQUIRE(mane_command(folder, "simulate small.toml -o a.mane --record").code == 0);
    const Result view = mane_command(folder, "view a.mane -o a.html");
    if (view.code == 2 && view.err.find("without its pages") != std::string::npos) {
        MESSAGE("skipped: built without pages");
        return;
    }
    REQUIRE(view.code == 0);
    CHECK(view.out.substr(0, 18) == "a.html: 4 frames, ");
    const std::string page = folder.read("a.html");
    CHECK(page.substr(0, 15) == "<!doctype html>");
    CHECK(page.find("id=\"run\">eJ") != std::string::npos);
    CHECK(page.find("<!-- ") == std::string::npos); // nothing is left to be put in
    CHECK(mane_command(folder, "view missing.mane -o x.html").code == 2);
    CHECK(mane_command(folder, "view a.mane -o no/where.html").code == 2);
}

TEST_CASE("layers and pictures of a frame are written; a wrong frame, layer or ending is refused") {
    Folder folder;
    REQUIRE(mane_command(folder, "simulate small.toml -o a.mane").code == 0);
    REQUIRE(mane_command(folder, "extract a.mane --frame 2 --strands 100 -o s.hair").code == 0);
    CHECK(folder.read("s.hair").starts_with("HAIR"));
    REQUIRE(mane_command(folder, "extract a.mane --layer skeleton -o k.obj").code == 0);
    REQUIRE(mane_command(folder, "extract a.mane --layer envelope -o e.ply").code == 0);
    CHECK(folder.read("e.ply").starts_with("ply"));
    REQUIRE(mane_command(folder, "extract a.mane --frame 3 --layer character -o c.obj").code == 0);
    // The character's first vertex is where the cache says, in the world.
    const CacheReader cache(folder / "a.mane");
    const Vec3d expected = Vec3d(cache.body_vertices(3, 0)[0]) + cache.frame(3).origin;
    const std::string obj = folder.read("c.obj");
    Vec3d first;
    std::istringstream line(obj.substr(obj.find("\nv ") + 3));
    line >> first.x >> first.y >> first.z;
    CHECK(length(first - expected) < 1e-5);

    check_bad(folder, "extract a.mane --frame 4 -o x.hair",
              "a.mane: has no frame 4, expected one under 4");
    CHECK(mane_command(folder, "extract a.mane --layer envelope -o e.hair").code == 2);
    CHECK(mane_command(folder, "extract a.mane --layer scalp -o e.ply").code == 2);
    CHECK(mane_command(folder, "extract a.mane -o no/where.hair").code == 2);
    if (mane_command(folder, "--help").out.find("\n  picture") == std::string::npos) {
        MESSAGE("skipped: built without pictures");
        return;
    }
    REQUIRE(mane_command(folder, "picture a.mane --frame 0 3 --view face back --size 40 30 "
                                 "--samples 1 --strands 100 -o p.png")
                .code == 0);
    CHECK(folder.read("p.png").starts_with("\x89PNG"));
    check_bad(folder, "picture a.mane --frame 0 9 -o p.png",
              "a.mane: has no frame 9, expected one under 4");
}

TEST_CASE("a signal ends a run after a whole frame and leaves a readable file") {
    for (const int number : {SIGINT, SIGTERM}) {
        Folder folder;
        const std::string scene = folder / "small.toml", output = folder / "a.mane",
                          part = output + ".part";
        const pid_t child = fork();
        REQUIRE(child >= 0);
        if (child == 0) {
            std::freopen((folder / "err.txt").c_str(), "w", stderr);
            execl(MANE_COMMAND, "mane", "simulate", scene.c_str(), "-o", output.c_str(), "--frames",
                  "1000000", nullptr);
            std::_Exit(127);
        }
        // Once the file holds a few frames the run is well under way. It never ends by itself.
        while (frames_in(part) < 3) {
            REQUIRE(waitpid(child, nullptr, WNOHANG) == 0);
            std::this_thread::sleep_for(std::chrono::milliseconds(10));
        }
        kill(child, number);
        int status = 0;
        waitpid(child, &status, 0);
        REQUIRE(WIFEXITED(status));
        CHECK(WEXITSTATUS(status) == 128 + number);
        CHECK_FALSE(fs::exists(part));
        const CacheReader cache(output);
        CHECK(cache.damage().empty());
        CHECK(cache.frame_count() >= 3);
        cache.verify();
        CHECK(nlohmann::json::parse(cache.statistics())["interrupted"] == true);
        CHECK(folder.read("err.txt").starts_with("mane: interrupted; "));
    }
}
