#include "mane/scene.h"

#include "scene/number.h"

namespace mane {

std::string to_toml(const Value& value) {
    struct Write {
        static std::string real(float x) {
            const std::string s = shortest(x);
            // TOML tells integers and reals apart, and the exponent of a whole number makes it a
            // real already.
            return s.find_first_of(".e") == std::string::npos ? s + ".0" : s;
        }
        std::string operator()(bool b) const { return b ? "true" : "false"; }
        std::string operator()(std::uint32_t i) const { return std::to_string(i); }
        std::string operator()(float x) const { return real(x); }
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

std::string write_scene(const SceneDesc& scene) {
    std::string out;
    std::string_view section;
    for (const Field& f : scene_fields()) {
        if (f.section != section) {
            out += (out.empty() ? "[" : "\n[") + std::string(f.section) + "]\n";
            section = f.section;
        }
        out += std::string(f.name) + " = " + to_toml(f.get(scene)) + "\n";
    }
    for (const WispOverride& o : scene.overrides) {
        out += "\n[[override]]\nwisps = [";
        for (std::size_t i = 0; i < o.wisps.size(); ++i)
            out += (i ? ", " : "") + std::to_string(o.wisps[i]);
        out += "]\n";
        for (const auto& [key, value] : o.settings)
            out += key + " = " + to_toml(value) + "\n";
    }
    return out;
}

} // namespace mane
