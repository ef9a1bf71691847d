# Flags of every target. -ffp-contract=off: the same bits on every instruction set (M39).
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
if(NOT EMSCRIPTEN) # its programs have no other address
    set(CMAKE_POSITION_INDEPENDENT_CODE ON)
endif()
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE)
    set(CMAKE_BUILD_TYPE Release)
endif()

find_program(MANE_CCACHE ccache)
if(MANE_CCACHE) # paths as seen from a build folder: folders beside each other share what they compile
    set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${CMAKE_SOURCE_DIR} CCACHE_NOHASHDIR=1 ${MANE_CCACHE})
endif()

add_library(mane_flags INTERFACE)
target_compile_options(mane_flags INTERFACE
    -ffp-contract=off -fno-math-errno -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -Werror)
# GCC 12 takes "text" + std::string for an overlapping copy (its bug 105651).
target_compile_options(mane_flags INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)

set(MANE_SANITIZE "" CACHE STRING "sanitizers, as -fsanitize= takes them")
if(MANE_SANITIZE)
    add_compile_options(-fsanitize=${MANE_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all)
    add_link_options(-fsanitize=${MANE_SANITIZE})
endif()

if(NOT EMSCRIPTEN)
    find_package(Threads REQUIRED)
endif()
add_library(mane_highway INTERFACE)
if(CMAKE_CROSSCOMPILING)
    # The system's packages are for another machine: of the header-only ones, the headers do. Highway's instruction set is then chosen
    # at compile time.
    set(MANE_HEADERS ${CMAKE_BINARY_DIR}/include)
    file(MAKE_DIRECTORY ${MANE_HEADERS})
    set(packages hwy/highway.h)
    if(EMSCRIPTEN) # reads scenes too
        list(APPEND packages toml++/toml.h nlohmann/json.hpp)
    endif()
    foreach(header ${packages})
        cmake_path(GET header PARENT_PATH package)
        find_path(MANE_HAS_${package} ${header} PATHS /usr/include NO_CMAKE_FIND_ROOT_PATH REQUIRED)
        file(CREATE_LINK ${MANE_HAS_${package}}/${package} ${MANE_HEADERS}/${package} COPY_ON_ERROR SYMBOLIC)
    endforeach()
    target_include_directories(mane_highway SYSTEM INTERFACE ${MANE_HEADERS})
    target_compile_definitions(mane_highway INTERFACE TOOLCHAIN_MISS_SYS_AUXV_H) # what Highway calls having no choice at run time on Arm
    target_link_libraries(mane_highway INTERFACE $<TARGET_NAME_IF_EXISTS:Threads::Threads>)
else()
    find_package(HWY REQUIRED)
    target_link_libraries(mane_highway INTERFACE hwy Threads::Threads)
endif()
if(EMSCRIPTEN)
    # -pthread for objects alone: both solvers of the page, with threads and without, are linked from the same ones (viewer/wasm).
    # The engine's own exceptions: emulated ones take every call that may throw out into JavaScript and back.
    add_compile_options(-msimd128 -fwasm-exceptions -pthread)
    add_link_options(-fwasm-exceptions)
endif()

# SSSE3 would only add to the build: every machine that has it and not SSE4 is from before 2008. SVE's vectors have no size
# when a program is built, so no structure can hold them, and Pack is one; every machine that has it has NEON.
target_compile_definitions(mane_highway INTERFACE
    "HWY_DISABLED_TARGETS=(HWY_SSSE3|HWY_SVE|HWY_SVE2|HWY_SVE_256|HWY_SVE2_128)")

# What vectors are worth is measured against the same code without any: neither ours nor the compiler's.
option(MANE_SCALAR "no SIMD at all, for `mane bench --plain-core`" OFF)
if(MANE_SCALAR)
    target_compile_definitions(mane_highway INTERFACE HWY_COMPILE_ONLY_SCALAR)
    add_compile_options(-fno-tree-vectorize -fno-tree-slp-vectorize)
endif()
