# SPDX-License-Identifier: BSD-3-Clause
#
# Runs a port's portfile as vcpkg does, for a release, with the libraries of this machine in the place of installed ports:
#   cmake -DPORTFILE=FILE -DFEATURES=LIST -DFOLDER=FOLDER -P vcpkg_stand_in.cmake
# The package is FOLDER/package afterwards.
cmake_minimum_required(VERSION 3.18)

set(PORT waitpoint)
set(CURRENT_INSTALLED_DIR /usr)
set(CURRENT_BUILDTREES_DIR "${FOLDER}/buildtrees")
set(CURRENT_PACKAGES_DIR "${FOLDER}/package")

function(vcpkg_check_linkage kind)
  if(NOT kind STREQUAL "ONLY_DYNAMIC_LIBRARY")
    message(FATAL_ERROR "vcpkg_check_linkage: expected ONLY_DYNAMIC_LIBRARY, found ${kind}")
  endif()
endfunction()

function(vcpkg_check_features)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "OUT_FEATURE_OPTIONS" "FEATURES")
  while(arg_FEATURES)
    list(POP_FRONT arg_FEATURES feature variable)
    if(feature IN_LIST FEATURES)
      set(${variable} ON PARENT_SCOPE)
    else()
      set(${variable} OFF PARENT_SCOPE)
    endif()
  endwhile()
endfunction()

function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGN}\nended with ${result}:\n${output}")
  endif()
endfunction()

function(vcpkg_configure_meson)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "SOURCE_PATH" "OPTIONS;ADDITIONAL_PROPERTIES")
  list(JOIN arg_ADDITIONAL_PROPERTIES "\n" properties)
  file(WRITE "${CURRENT_BUILDTREES_DIR}/native.txt" "[properties]\n${properties}\n[built-in options]\ndefault_library = 'shared'\n")
  run(meson setup ${arg_OPTIONS} --backend ninja --wrap-mode nodownload -Doptimization=2 -Ddebug=false --libdir lib
    --native-file "${CURRENT_BUILDTREES_DIR}/native.txt" --pkgconfig.relocatable --prefix "${CURRENT_PACKAGES_DIR}"
    "${CURRENT_BUILDTREES_DIR}/rel" "${arg_SOURCE_PATH}"
  )
endfunction()

function(vcpkg_install_meson)
  run(meson install -C "${CURRENT_BUILDTREES_DIR}/rel")
endfunction()

function(vcpkg_fixup_pkgconfig)
endfunction()

function(vcpkg_replace_string file from to)
  file(READ "${file}" text)
  string(REPLACE "${from}" "${to}" replaced "${text}")
  if(replaced STREQUAL text)
    message(FATAL_ERROR "vcpkg_replace_string: ${file} does not contain ${from}")
  endif()
  file(WRITE "${file}" "${replaced}")
endfunction()

function(vcpkg_install_copyright)
  cmake_parse_arguments(PARSE_ARGV 0 arg "" "" "FILE_LIST")
  configure_file("${arg_FILE_LIST}" "${CURRENT_PACKAGES_DIR}/share/${PORT}/copyright" COPYONLY)
endfunction()

include("${PORTFILE}")
