#pragma once

#include "bench/sample.h"
#include "commands.h"

#include <string>
#include <vector>

namespace mane::bench {

enum class Kind { simulation, strands, moving_strands, cache, machine };

/// One thing to measure. Names are paths: the first part is the group, that is, the table and the
/// CSV file.
struct Case {
    std::string name = {};
    Kind kind = Kind::simulation;
    std::string scene = {};           ///< file
    std::string rates = {};           ///< preset; empty: the scene's own
    std::string instruction_set = {}; ///< empty: the best
    unsigned threads = 1;
    std::uint32_t most_frames = ~0u, most_preroll = ~0u; ///< frames, if the scene has more
    std::string program = {};                            ///< that runs it; empty: this one
    bool judge = false; ///< measure the quality too: once, since every run gives the same bits

    std::string group() const { return name.substr(0, name.find('/')); }
};

/// All that `mane bench` measures, in the order of its tables.
std::vector<Case> all_cases(const tool::BenchOptions& options);
/// The cases that `names` begin: `series`, `series/wide`, `styles/long/paper`. Throws InputError,
/// with the nearest name, for one that begins none.
std::vector<Case> selected(const std::vector<Case>& cases, const std::vector<std::string>& names);

Json to_json(const Case& c);
Case from_json(const Json& json);

} // namespace mane::bench
