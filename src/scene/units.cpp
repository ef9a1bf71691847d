#include "scene/units.h"

#include "base/functions.h"

namespace mane {
namespace {

struct Unit {
    std::string_view written;
    std::string_view unit; // of the table of fields
    double factor;
};

// Divisions, not products with 0.001 and the like: 6 mm becomes the double nearest to 0.006.
constexpr Unit kUnits[] = {
    {"km", "m", 1000},
    {"cm", "m", 1 / 100.0},
    {"mm", "m", 1 / 1000.0},
    {"um", "m", 1 / 1e6},
    {"µm", "m", 1 / 1e6},
    {"ms", "s", 1 / 1000.0},
    {"min", "s", 60},
    {"%", "1", 1 / 100.0},
    {"g/m", "kg/m", 1 / 1000.0},
    {"mg/m", "kg/m", 1 / 1e6},
    {"mm/s", "m/s", 1 / 1000.0},
    {"cm/s", "m/s", 1 / 100.0},
    {"km/h", "m/s", 1 / 3.6},
    {"m/s^2", "m/s²", 1},
    {"m/s2", "m/s²", 1},
    {"kHz", "Hz", 1000},
    {"fps", "Hz", 1},
    {"rad", "deg", 180 / kPi},
    {"°", "deg", 1},
    {"1/min", "1/s", 1 / 60.0},
};

} // namespace

std::optional<double> unit_factor(std::string_view written, std::string_view unit) {
    if (written.empty() || written == unit)
        return 1.0;
    for (const Unit& u : kUnits)
        if (u.written == written && u.unit == unit)
            return u.factor;
    return std::nullopt;
}

} // namespace mane
