# Installs what mane builds with on a fresh Debian or Ubuntu machine. Sourced by demo.sh and test.sh, from the project's root.
# Packages that are there already cost nothing: no network is used then.

mane_packages_build="cmake ninja-build g++ pkg-config libhwy-dev libcli11-dev libtomlplusplus-dev nlohmann-json3-dev libzstd-dev libxxhash-dev libembree-dev libpng-dev zlib1g-dev nodejs npm ccache"
mane_packages_live="emscripten libcpp-httplib-dev" # `mane live`; the rest builds without
mane_packages_test="doctest-dev clang-14 libclang-rt-14-dev clang-format-14 clang-tidy-14 chromium $mane_packages_live"
mane_packages_neon="g++-aarch64-linux-gnu qemu-user" # not all machines can have a cross compiler

mane_install() {
    local missing=()
    for package in "$@"; do
        # What stands in for these may come from elsewhere than the system's packages.
        case "$package" in
            nodejs) command -v node >/dev/null && continue ;;
            npm | chromium) command -v "$package" >/dev/null && continue ;;
        esac
        dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q 'ok installed' || missing+=("$package")
    done
    [ ${#missing[@]} -eq 0 ] && return 0
    echo "installing: ${missing[*]}"
    local as_root=()
    [ "$(id -u)" -eq 0 ] || as_root=(sudo)
    "${as_root[@]}" apt-get update -qq
    DEBIAN_FRONTEND=noninteractive "${as_root[@]}" apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
}
