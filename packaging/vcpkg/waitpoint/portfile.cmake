# SPDX-License-Identifier: BSD-3-Clause
#
# An overlay port that builds the tree it lies in: vcpkg install waitpoint --overlay-ports=packaging/vcpkg
# It has the libraries; the program waitpoint, with the libraries that it preloads, is in Debian's packages.

# The shared libraries contain what they use of others, and export the names of this project alone.
vcpkg_check_linkage(ONLY_DYNAMIC_LIBRARY)

get_filename_component(SOURCE_PATH "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)

vcpkg_check_features(OUT_FEATURE_OPTIONS unused FEATURES robots WITH_ROBOTS)
set(robots false)
if(WITH_ROBOTS)
  set(robots true)
endif()

vcpkg_configure_meson(
  SOURCE_PATH "${SOURCE_PATH}"
  OPTIONS
    -Drobots=${robots}
    -Dauto_features=disabled
    -Dsplit_debug=false
    -Dwerror=false
  ADDITIONAL_PROPERTIES
    "boost_root = '${CURRENT_INSTALLED_DIR}'"
)
vcpkg_install_meson()
vcpkg_fixup_pkgconfig()

# Where find_package() of vcpkg's toolchain looks, with its paths from there.
file(MAKE_DIRECTORY "${CURRENT_PACKAGES_DIR}/share/${PORT}")
foreach(config IN ITEMS waitpoint-config.cmake waitpoint-config-version.cmake)
  file(RENAME "${CURRENT_PACKAGES_DIR}/lib/cmake/waitpoint/${config}" "${CURRENT_PACKAGES_DIR}/share/${PORT}/${config}")
endforeach()
vcpkg_replace_string("${CURRENT_PACKAGES_DIR}/share/${PORT}/waitpoint-config.cmake"
  [[${CMAKE_CURRENT_LIST_DIR}/../..]] [[${CMAKE_CURRENT_LIST_DIR}/../../lib]]
)
# A triplet may ask for a release alone, which projects that are built for debugging link, too.
if(NOT DEFINED VCPKG_BUILD_TYPE)
  vcpkg_replace_string("${CURRENT_PACKAGES_DIR}/share/${PORT}/waitpoint-config.cmake"
    [["${waitpoint_libraries}/${library};]]
    [["${waitpoint_libraries}/$<$<CONFIG:Debug>:../debug/lib/>${library};]]
  )
endif()
file(REMOVE_RECURSE
  "${CURRENT_PACKAGES_DIR}/bin"
  "${CURRENT_PACKAGES_DIR}/debug/bin"
  "${CURRENT_PACKAGES_DIR}/debug/include"
  "${CURRENT_PACKAGES_DIR}/debug/lib/cmake"
  "${CURRENT_PACKAGES_DIR}/debug/lib/waitpoint"
  "${CURRENT_PACKAGES_DIR}/debug/share"
  "${CURRENT_PACKAGES_DIR}/lib/cmake"
  "${CURRENT_PACKAGES_DIR}/lib/waitpoint"
  "${CURRENT_PACKAGES_DIR}/share/bash-completion"
  "${CURRENT_PACKAGES_DIR}/share/fish"
  "${CURRENT_PACKAGES_DIR}/share/man"
  "${CURRENT_PACKAGES_DIR}/share/zsh"
)
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
