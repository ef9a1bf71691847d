#include "mane/scene.h"

#include "scene/number.h"

namespace mane {

namespace {

// TOML tells integers and reals apart; an exponent makes a real already.
template <typename Real> std::string real(Real x) {
    const std::string text = shortest(x);
    return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

} // namespace

std::string to_toml(const Value& value) {
    struct Write {
        std::string operator()(bool b) const { return b ? "true" : "false"; }
        std::string operator()(std::uint32_t i) const { return std::to_string(i); }
        std::string operator()(float x) const { return real(x); }
        std::string operator()(double x) const { return real(x); }
        std::string operator()(const Ramp& r) const {
            return r.root == r.tip ? real(r.root) : "[" + real(r.root) + ", " + real(r.tip) + "]";
        }
        std::string operator()(const Vec3& v) const {
            return "[" + real(v.x) + ", " + real(v.y) + ", " + real(v.z) + "]";
        }
        std::string operator()(const std::string& s) const {
            std::string quoted = "\"";
            for (const char c : s) {
                const auto code = static_cast<unsigned char>(c);
                if (c == '"' || c == '\\')
                    quoted += {'\\', c};
                else if (code < 0x20 || code == 0x7f) {
                    constexpr char kHex[] = "0123456789abcdef";
                    quoted += {'\\', 'u', '0', '0', kHex[code >> 4], kHex[code & 15]};
                } else
                    quoted += c;
            }
            return quoted + '"';
        }
    };
    return std::visit(Write{}, value);
}

namespace {

template <typename Root>
void write_fields(std::string& out, const Root& root, std::string_view section) {
    for (const FieldOf<Root>& f : fields_of<Root>())
        if (f.section == section)
            out += std::string(f.name) + " = " + to_toml(f.get(root)) + "\n";
}

void write_obstacle(std::string& out, const ObstacleDesc& obstacle) {
    out += "\n[[obstacle]]\n";
    write_fields(out, obstacle, "obstacle");
    for (const ObstacleKeyDesc& key : obstacle.keys) {
        out += "[[obstacle.key]]\n";
        write_fields(out, key, "obstacle.key");
    }
}

void write_override(std::string& out, const WispOverride& o) {
    out += "\n[[override]]\nwisps = [";
    for (std::size_t i = 0; i < o.wisps.size(); ++i)
        out += (i ? ", " : "") + std::to_string(o.wisps[i]);
    out += "]\n";
    for (const auto& [key, value] : o.settings)
        out += key + " = " + to_toml(value) + "\n";
}

} // namespace

std::string write_scene(const SceneDesc& scene) {
    std::string out;
    std::string_view section;
    for (const Field& f : fields_of<SceneDesc>()) {
        if (f.section == section)
            continue;
        section = f.section;
        out += (out.empty() ? "[" : "\n[") + std::string(section) + "]\n";
        write_fields(out, scene, section);
    }
    for (const ObstacleDesc& obstacle : scene.obstacles)
        write_obstacle(out, obstacle);
    for (const WispOverride& o : scene.overrides)
        write_override(out, o);
    return out;
}

} // namespace mane
