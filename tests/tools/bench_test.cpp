#include "command.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <sstream>
#include <thread>
#include <vector>

using Json = nlohmann::json;

namespace {

/// A project whose scenes are all the small one.
struct Project : Folder {
    Project() {
        fs::create_directories(path / "scenes");
        fs::create_directories(path / "bench/scenes");
        for (const char* name : {"short", "medium", "long"})
            fs::copy(path / "small.toml", path / "scenes" / (std::string(name) + ".toml"));
        for (const std::string width : {"wide", "slender"})
            for (const std::string wisps : {"100", "1000", "10000"})
                fs::copy(path / "small.toml",
                         path / "bench/scenes" / (width + "-" + wisps + ".toml"));
    }
};

Json medians(const Json& result, const std::string& name) {
    for (const Json& c : result["cases"])
        if (c["name"] == name)
            return c["medians"];
    FAIL("no case " << name);
    return {};
}

std::vector<std::string> lines(const std::string& text) {
    std::vector<std::string> all;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);)
        all.push_back(line);
    return all;
}

} // namespace

TEST_CASE("bench measures simulations, and what it says fits together") {
    Project project;
    const Result run = mane_command(
        project,
        "bench --only styles/long/paper series/wide-100 core --runs 2 --frames 2 --preroll 2 "
        "--threads 2 --json b.json --csv csv");
    CHECK(run.err.empty());
    REQUIRE(run.code == 0);
    const Json all = Json::parse(project.read("b.json"));
    CHECK(all["runs"] == 2);
    CHECK(all["cases"].size() >= 4);

    const Json m = medians(all, "styles/long/paper");
    CHECK(m["wisps"] == 8);
    CHECK(m["segments"] == 32);
    CHECK(m["packet_rows"] == 4.0); // eight wisps are half a packet
    CHECK(m["frames"] == 2);
    CHECK(m["simulated_seconds"].get<double>() == doctest::Approx(2 / 24.0));
    CHECK(m["peak_mb"].get<double>() > 1);
    CHECK(m["cost"]["forces_per_packet"].get<double>() > 0);
    for (const char* figure : {"skeleton_inside", "skeleton_depth", "stretch", "area_mean"})
        CHECK(m["quality"].contains(figure));

    for (const Json& c : all["cases"]) {
        CAPTURE(c["name"].get<std::string>());
        REQUIRE(c["runs"].size() == 2);
        for (const Json& r : c["runs"]) { // of a single run, not of medians, which need not add up
            double stages = 0;
            for (const Json& stage : r["stage_ms"])
                stages += stage.get<double>();
            CHECK(stages == doctest::Approx(r["frame_ms"].get<double>()));
            CHECK(r["frame_ms"].get<double>() * 2 ==
                  doctest::Approx(1e3 * r["wall_seconds"].get<double>()));
            CHECK(r["times_real_time"].get<double>() * r["wall_seconds"].get<double>() ==
                  doctest::Approx(r["simulated_seconds"].get<double>()));
            CHECK(r["state_hash"] == c["runs"][0]["state_hash"]);
        }
    }
    const Json one = medians(all, "series/wide-100/1"), two = medians(all, "series/wide-100/2");
    CHECK(one["threads"] == 1);
    CHECK(two["threads"] == 2);
    CHECK(one["state_hash"] == two["state_hash"]);
    CHECK(medians(all, "core/scalar")["state_hash"] == one["state_hash"]);
    CHECK(medians(all, "core/scalar")["instruction_set"] == "scalar");

    const std::vector<std::string> csv = lines(project.read("csv/series.csv"));
    REQUIRE(csv.size() == 4);
    CHECK(csv[0].starts_with("# mane 0."));
    CHECK(csv[1].starts_with("case,scene,"));
    CHECK(csv[2].starts_with("series/wide-100/1,"));
    CHECK(std::ranges::count(csv[1], ',') == std::ranges::count(csv[2], ','));
    CHECK(run.out.find("times the first one's time") != std::string::npos);
}

TEST_CASE(
    "bench measures skeleton and envelope alone, with the same bits for any instruction set") {
    Project project;
    const Result run = mane_command(
        project,
        "bench --only kernel --runs 2 --frames 1 --json b.json --kernel " MANE_BENCH_KERNEL);
    CHECK(run.err.empty());
    REQUIRE(run.code == 0);
    const Json all = Json::parse(project.read("b.json"));
    const Json scalar = medians(all, "kernel/long/scalar");
    CHECK(scalar["packet_rows"] == 4.0); // eight wisps of four segments are half a packet
    CHECK(all["cases"].size() >= 4);
    for (const Json& c : all["cases"]) { // all scenes are the small one
        const Json& m = c["medians"];
        CHECK(c["name"].get<std::string>().ends_with(m["instruction_set"].get<std::string>()));
        CHECK(m["state_hash"] == scalar["state_hash"]);
        CHECK(m["cost"]["forces_per_packet"].get<double>() > 0);
        CHECK(m["cost"]["positions_per_packet"].get<double>() > 0);
    }
    CHECK(run.out.find("skeleton and envelope alone") != std::string::npos);
    CHECK(mane_command(project, "bench --only kernel").code == 2); // no program, no such cases
}

TEST_CASE("bench measures strands, cache and the machine") {
    Project project;
    const Result run =
        mane_command(project, "bench --only strands cache machine --runs 1 --json b.json");
    REQUIRE(run.code == 0);
    const Json all = Json::parse(project.read("b.json"));
    const Json strands = medians(all, "strands/plain/1");
    CHECK(strands["strands"] == 100000);
    CHECK(strands["million_strands_of_32_per_second"].get<double>() *
              strands["ns_per_vertex"].get<double>() ==
          doctest::Approx(1e3 / 32));
    const Json cache = medians(all, "cache");
    CHECK(cache["write_mb_per_second"].get<double>() > 0);
    CHECK(cache["read_mb_per_second"].get<double>() > 0);
    CHECK(cache["packed_share"].get<double>() < 1);
    const Json machine = medians(all, "machine");
    CHECK(machine["gflops"].contains("scalar"));
    for (const Json& set : machine["gflops"])
        for (const char* what : {"multiply", "add", "multiply_add", "fused"})
            CHECK(set[what].get<double>() > 0);
    CHECK(machine["triad_gb_per_second"]["memory"].get<double>() > 0);
}

TEST_CASE("bench names its cases, and knows those that begin alike") {
    Project project;
    const auto listed = [&](const std::string& only) {
        return lines(mane_command(project, "bench --list --threads 3 " + only).out);
    };
    CHECK(listed("--only series/wide-1000") ==
          std::vector<std::string>{"series/wide-1000/1", "series/wide-1000/3"});
    CHECK(listed("--only series/slender").size() == 6);
    CHECK(listed("--only styles").size() == 9);
    CHECK(listed("--only styles/long/paper cache").size() == 2);

    const auto complaint = [&](const std::string& only) {
        const Result r = mane_command(project, "bench --only " + only);
        CHECK(r.code == 2);
        CHECK(r.out.empty());
        return r.err;
    };
    CHECK(complaint("seris") == "mane: --only: no case \"seris\" (did you mean series?)\n");
    CHECK(complaint("styles/lnog") ==
          "mane: --only: no case \"styles/lnog\" (did you mean styles/long?)\n");
    CHECK(
        complaint("hair").starts_with("mane: --only: no case \"hair\" (known: machine, styles, "));
}

TEST_CASE("a case that cannot run is said with its name") {
    Project project;
    fs::remove(project.path / "scenes/long.toml");
    const Result r = mane_command(project, "bench --only styles/long/paper --runs 1");
    CHECK(r.code == 2);
    CHECK(r.err == "mane: styles/long/paper: ./scenes/long.toml: cannot be read\n");
}

TEST_CASE("a signal ends bench after the rounds that are whole, and its runs with it") {
    Project project;
    const std::string command =
        "cd '" + project.path.string() +
        "' && timeout --preserve-status -s TERM 3 '" MANE_COMMAND
        "' bench --only styles/long/paper --runs 1000 --frames 1 --preroll 0 "
        ">out.txt 2>err.txt";
    const int status = std::system(command.c_str());
    CHECK(WEXITSTATUS(status) == 143);
    const std::string said = project.read("err.txt");
    CHECK(said.starts_with("mane: interrupted after "));
    CHECK(said.ends_with(" of 1000 rounds\n"));
    if (!said.starts_with("mane: interrupted after 0 "))
        CHECK(project.read("out.txt").find("styles/long/paper") != std::string::npos);
}
