# Asperity::asperity is the shared library, or the static one where no shared one is installed;
# Asperity::asperity_static is always the static one.
#
# Versions and libraries of the system are those of asperity.pc, so that this file serves `make install`, `cargo cinstall`
# and an archive that was unpacked anywhere.

function(_asperity_first result) # The first of the files that exist.
  set(${result} "" PARENT_SCOPE)
  foreach(file IN LISTS ARGN)
    if(EXISTS "${file}")
      set(${result} "${file}" PARENT_SCOPE)
      return()
    endif()
  endforeach()
endfunction()

get_filename_component(_asperity_prefix "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)
get_filename_component(_asperity_above "${CMAKE_CURRENT_LIST_DIR}/../.." ABSOLUTE)
_asperity_first(_asperity_pc "${_asperity_above}/pkgconfig/asperity.pc"
  "${_asperity_prefix}/lib/pkgconfig/asperity.pc" "${_asperity_prefix}/lib64/pkgconfig/asperity.pc"
  "${_asperity_prefix}/lib/${CMAKE_LIBRARY_ARCHITECTURE}/pkgconfig/asperity.pc")
if(NOT _asperity_pc)
  set(Asperity_FOUND FALSE)
  set(Asperity_NOT_FOUND_MESSAGE "no pkgconfig/asperity.pc in ${_asperity_above}: install the library again")
  return()
endif()
get_filename_component(_asperity_lib "${_asperity_pc}/../.." ABSOLUTE)
function(_asperity_field name result)
  file(STRINGS "${_asperity_lib}/pkgconfig/asperity.pc" line REGEX "^${name}[:=]")
  string(REGEX REPLACE "^${name}[:=] *" "" line "${line}")
  set(${result} "${line}" PARENT_SCOPE)
endfunction()
_asperity_field(Version Asperity_VERSION)
_asperity_field(Libs.private _asperity_system)
separate_arguments(_asperity_system UNIX_COMMAND "${_asperity_system}")
# Beside the libraries, also if the prefix was moved; else where they were installed.
_asperity_field(includedir _asperity_installed)
_asperity_field(prefix _asperity_pc_prefix)
string(REPLACE "\${prefix}" "${_asperity_pc_prefix}" _asperity_installed "${_asperity_installed}")
_asperity_first(_asperity_include "${_asperity_lib}/../include/asperity.h"
  "${_asperity_lib}/../../include/asperity.h" "${_asperity_installed}/asperity.h")
get_filename_component(_asperity_include "${_asperity_include}/.." ABSOLUTE)

string(REGEX MATCH "^(0\\.[0-9]+|[1-9][0-9]*)" _asperity_abi "${Asperity_VERSION}")
set(_asperity_import "")
if(WIN32)
  # MinGW's names, then those of MSVC; a DLL is beside programs.
  _asperity_first(_asperity_static "${_asperity_lib}/libasperity.a" "${_asperity_lib}/asperity.lib")
  _asperity_first(_asperity_import "${_asperity_lib}/libasperity.dll.a" "${_asperity_lib}/asperity.dll.lib")
  _asperity_first(_asperity_shared "${_asperity_lib}/../bin/asperity-${_asperity_abi}.dll"
    "${_asperity_lib}/../bin/asperity.dll")
  if(NOT _asperity_import)
    set(_asperity_shared "")
  endif()
elseif(APPLE)
  _asperity_first(_asperity_static "${_asperity_lib}/libasperity.a")
  _asperity_first(_asperity_shared "${_asperity_lib}/libasperity.dylib")
else()
  _asperity_first(_asperity_static "${_asperity_lib}/libasperity.a")
  _asperity_first(_asperity_shared "${_asperity_lib}/libasperity.so")
endif()

if(_asperity_static AND NOT TARGET Asperity::asperity_static)
  add_library(Asperity::asperity_static STATIC IMPORTED)
  set_target_properties(Asperity::asperity_static PROPERTIES
    IMPORTED_LOCATION "${_asperity_static}"
    IMPORTED_LINK_INTERFACE_LANGUAGES "C"
    INTERFACE_INCLUDE_DIRECTORIES "${_asperity_include}"
    # What Rust's standard library needs of the system.
    INTERFACE_LINK_LIBRARIES "${_asperity_system}")
endif()

if(NOT TARGET Asperity::asperity)
  if(_asperity_shared)
    # The loader finds the file by its ABI; the name without a version is for linkers.
    get_filename_component(_asperity_shared "${_asperity_shared}" REALPATH)
    add_library(Asperity::asperity SHARED IMPORTED)
    set_target_properties(Asperity::asperity PROPERTIES
      IMPORTED_LOCATION "${_asperity_shared}"
      INTERFACE_INCLUDE_DIRECTORIES "${_asperity_include}")
    if(_asperity_import)
      set_target_properties(Asperity::asperity PROPERTIES IMPORTED_IMPLIB "${_asperity_import}")
    elseif(NOT APPLE)
      set_target_properties(Asperity::asperity PROPERTIES IMPORTED_SONAME "libasperity.so.${_asperity_abi}")
    endif()
  elseif(TARGET Asperity::asperity_static)
    add_library(Asperity::asperity INTERFACE IMPORTED)
    set_target_properties(Asperity::asperity PROPERTIES
      INTERFACE_LINK_LIBRARIES Asperity::asperity_static)
  else()
    set(Asperity_FOUND FALSE)
    set(Asperity_NOT_FOUND_MESSAGE "neither a shared nor a static library in ${_asperity_lib}: install it again")
  endif()
endif()

foreach(_asperity_name prefix above pc lib system installed pc_prefix include abi import shared static)
  unset(_asperity_${_asperity_name})
endforeach()
unset(_asperity_name)
