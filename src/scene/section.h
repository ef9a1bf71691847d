#pragma once

#include "mane/fields.h"

#include <array>
#include <cstddef>
#include <type_traits>
#include <utility>

namespace mane {

/// The names of an enumeration, in the order of its values; specialised beside the table.
template <typename Enum> inline constexpr std::array<std::string_view, 0> kChoices{};

/// Follows member pointers from `root`, one after the other.
template <auto... Path, typename Root> constexpr auto& reach(Root& root) {
    return (root.*....*Path);
}

template <typename T> Value to_value(const T& member) {
    if constexpr (std::is_enum_v<T>)
        return std::string(kChoices<T>[static_cast<std::size_t>(member)]);
    else
        return member;
}

template <typename T> void from_value(T& member, const Value& value) {
    if constexpr (std::is_enum_v<T>) {
        for (std::size_t i = 0; i < kChoices<T>.size(); ++i)
            if (std::get<std::string>(value) == kChoices<T>[i])
                member = static_cast<T>(i);
    } else {
        member = std::get<T>(value);
    }
}

/// A section of the scene file: the struct that `Path` leads to from a default-constructed `Root`.
template <typename Root, auto... Path> struct Section {
    std::string_view name;

    template <auto Member> FieldOf<Root> field(std::string_view key, std::string_view unit,
                                               Range range, FieldUse use,
                                               std::string_view help) const {
        using T = std::remove_cvref_t<decltype(reach<Path..., Member>(std::declval<Root&>()))>;
        FieldOf<Root> f;
        f.section = name, f.name = key, f.unit = unit, f.range = range, f.use = use, f.help = help;
        if constexpr (std::is_enum_v<T>)
            f.choices.assign(kChoices<T>.begin(), kChoices<T>.end());
        f.get = [](const Root& root) { return to_value(reach<Path..., Member>(root)); };
        f.set = [](Root& root, const Value& value) {
            from_value(reach<Path..., Member>(root), value);
        };
        f.standard = f.get(Root{});
        return f;
    }
    /// A switch, a choice or text: neither unit nor range.
    template <auto Member>
    FieldOf<Root> field(std::string_view key, FieldUse use, std::string_view help) const {
        return field<Member>(key, "", {}, use, help);
    }
};

} // namespace mane
