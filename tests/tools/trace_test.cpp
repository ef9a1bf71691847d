#include "command.h"

#include "mane/world.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <map>
#include <set>
#include <vector>

using Json = nlohmann::json;

namespace {

struct Event {
    std::string name;
    double begin, end; ///< [µs]
    Json arguments;
};

std::vector<Event> events_in(const Json& trace) {
    std::vector<Event> events;
    for (const Json& e : trace["traceEvents"])
        if (e["ph"] == "X") {
            CHECK(e["pid"] == 1);
            CHECK(e["tid"] == 1);
            const double begin = e["ts"], duration = e["dur"];
            events.push_back({e["name"], begin, begin + duration, e.value("args", Json())});
        }
    return events;
}

std::set<std::string> stage_names() {
    std::set<std::string> names;
    for (std::size_t s = 0; s < static_cast<std::size_t>(mane::Stage::count); ++s)
        names.insert(mane::stage_name(static_cast<mane::Stage>(s)));
    return names;
}

} // namespace

TEST_CASE("a trace has every stage of every step, inside its frame, and changes no bit") {
    Folder folder;
    REQUIRE(mane_command(folder, "simulate small.toml -o a.mane --stats a.json --trace trace.json "
                                 "--set schedule.preroll=0.1")
                .code == 0);
    REQUIRE(mane_command(folder, "simulate small.toml -o b.mane --stats b.json --set "
                                 "schedule.preroll=0.1")
                .code == 0);
    const Json statistics = Json::parse(folder.read("a.json"));
    CHECK(statistics["state_hash"] == Json::parse(folder.read("b.json"))["state_hash"]);
    CHECK_FALSE(fs::exists(folder / "trace.json.part"));

    const std::vector<Event> events = events_in(Json::parse(folder.read("trace.json")));
    const std::set<std::string> stages = stage_names();
    std::vector<const Event*> frames, writings;
    std::map<std::string, double> seconds;
    std::map<std::string, std::size_t> count;
    for (const Event& e : events) {
        ++count[e.name];
        seconds[e.name] += 1e-6 * (e.end - e.begin);
        if (e.name == "frame")
            frames.push_back(&e);
        else if (e.name == "writing")
            writings.push_back(&e);
        else
            CHECK(stages.contains(e.name));
    }

    // Times are exact to the nanosecond, so the sums are those of the statistics but for rounding.
    for (const std::string& stage : stages) {
        CAPTURE(stage);
        CHECK(std::fabs(seconds[stage] - statistics["stages"][stage].get<double>()) < 1e-9);
    }
    const std::size_t steps = statistics["steps"];
    CHECK(count["forces"] == steps);
    CHECK(count["velocities"] == steps);
    CHECK(count["positions"] == steps);
    CHECK(count["wisp detection"] == statistics["wisp_detections"]);

    // 0.1 s are three frames at 24 Hz, of which the first is where the run begins.
    REQUIRE(frames.size() == 6);
    CHECK(writings.size() == 4);
    for (std::size_t f = 0; f < frames.size(); ++f)
        CHECK(frames[f]->arguments["frame"] == static_cast<int>(f) - 2);
    const auto inside_one = [&](const Event& e) {
        for (const Event* f : frames)
            if (f->begin <= e.begin && e.end <= f->end)
                return true;
        return false;
    };
    double stage_end = 0;
    for (const Event& e : events)
        if (stages.contains(e.name)) {
            CHECK(inside_one(e));
            CHECK(e.begin >= stage_end - 1e-3); // one after the other
            stage_end = e.end;
        }
    for (const Event* w : writings)
        CHECK_FALSE(inside_one(*w));
}

TEST_CASE("a trace that cannot be written is said before the run") {
    Folder folder;
    const Result r = mane_command(folder, "simulate small.toml -o a.mane --trace no/where.json");
    CHECK(r.code == 2);
    CHECK(r.err == "mane: no/where.json: cannot be written\n");
    CHECK_FALSE(fs::exists(folder / "a.mane"));
    CHECK_FALSE(fs::exists(folder / "a.mane.part"));
}
