# What `cmake --install` puts in place, and how `find_package(mane)` finds it. The core needs nothing but Highway and threads;
# the component `formats` (scene files, caches) also zstd and xxHash.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(mane_config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/mane)

install(DIRECTORY include/mane DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT library PATTERN picture.h EXCLUDE) # no library for it
install(TARGETS mane EXPORT mane_core COMPONENT library)
install(EXPORT mane_core FILE mane-core.cmake NAMESPACE mane:: DESTINATION ${mane_config_dir} COMPONENT library)
if(MANE_TOOLS)
    set_target_properties(mane_formats PROPERTIES EXPORT_NAME formats)
    install(TARGETS mane_formats EXPORT mane_formats COMPONENT library)
    install(EXPORT mane_formats FILE mane-formats.cmake NAMESPACE mane:: DESTINATION ${mane_config_dir} COMPONENT library)
    install(TARGETS mane_command COMPONENT command)
endif()

configure_package_config_file(cmake/mane-config.cmake.in mane-config.cmake INSTALL_DESTINATION ${mane_config_dir})
write_basic_package_version_file(mane-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/mane-config.cmake ${CMAKE_CURRENT_BINARY_DIR}/mane-config-version.cmake
    DESTINATION ${mane_config_dir} COMPONENT library)
