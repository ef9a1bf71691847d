#include "bench/results.h"

#include "base/instruction_set.h"
#include "base/whole_file.h"
#include "mane/error.h"

#include <fmt/core.h>

#include <algorithm>
#include <ctime>
#include <fstream>
#include <thread>

namespace mane::bench {
namespace {

std::string processor_name() {
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.starts_with("model name"))
            return line.substr(std::min(line.size(), line.find(':') + 2));
    return "an unknown processor";
}

std::string today() {
    const std::time_t now = std::time(nullptr);
    char text[16];
    std::strftime(text, sizeof text, "%Y-%m-%d", std::gmtime(&now));
    return text;
}

/// Adds the members of a group as columns of their own: `contacts.friction`.
void flatten(const Json& json, const std::string& prefix, Json& flat) {
    for (const auto& [name, value] : json.items())
        if (value.is_object())
            flatten(value, prefix + name + ".", flat);
        else
            flat[prefix + name] = value;
}

std::string cell(const Json& value) {
    if (value.is_number_float())
        return fmt::format("{:.6g}", value.get<double>());
    return value.is_string() ? value.get<std::string>() : value.dump();
}

std::string csv_of(const Circumstances& where, const std::vector<const Result*>& group) {
    std::vector<std::string> columns;
    std::vector<Json> rows;
    for (const Result* result : group) {
        Json flat = Json::object();
        flatten(result->medians, "", flat);
        for (const auto& item : flat.items())
            if (std::ranges::find(columns, item.key()) == columns.end())
                columns.push_back(item.key());
        rows.push_back(std::move(flat));
    }
    std::string text = fmt::format(
        "# mane {}, {}, {}, {} hardware threads, {}, medians of {} interleaved runs\ncase",
        where.version, where.date, where.processor, where.hardware_threads, where.instruction_set,
        where.runs);
    for (const std::string& column : columns)
        text += "," + column;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        text += "\n" + group[i]->what.name;
        for (const std::string& column : columns)
            text += "," + (rows[i].contains(column) ? cell(rows[i][column]) : "");
    }
    return text + "\n";
}

} // namespace

Circumstances circumstances(std::uint32_t runs) {
    return {MANE_VERSION,
            today(),
            processor_name(),
            instruction_set("").name,
            std::max(1u, std::thread::hardware_concurrency()),
            runs};
}

std::string to_json(const Circumstances& where, const std::vector<Result>& results) {
    Json cases = Json::array();
    for (const Result& result : results)
        cases.push_back(
            {{"name", result.what.name}, {"medians", result.medians}, {"runs", result.runs}});
    return Json{{"version", where.version},
                {"date", where.date},
                {"processor", where.processor},
                {"hardware_threads", where.hardware_threads},
                {"instruction_set", where.instruction_set},
                {"runs", where.runs},
                {"cases", cases}}
               .dump(2) +
           "\n";
}

void write_csv(const Circumstances& where, const std::vector<Result>& results,
               const std::filesystem::path& folder) {
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
        throw InputError(folder.string() + ": " + error.message());
    std::vector<std::string> written;
    for (const Result& result : results) {
        const std::string group = result.what.group();
        if (std::ranges::find(written, group) != written.end())
            continue;
        written.push_back(group);
        std::vector<const Result*> members;
        for (const Result& other : results)
            if (other.what.group() == group)
                members.push_back(&other);
        WholeFile file(folder / (group + ".csv"));
        file.write(csv_of(where, members));
        file.finish();
    }
}

} // namespace mane::bench
