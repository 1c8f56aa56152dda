# The C library as packages/build has packed it; no Rust is needed. Not run yet: the checksums are those of a release.
#
#   vcpkg install asperity --overlay-ports=packages/vcpkg
#
# ASPERITY_SHA512 is what `sha512sum` gives for the archive of the triplet, as vcpkg itself says where it differs.
if(VCPKG_TARGET_IS_OSX)
  set(ASPERITY_TARGET aarch64-apple-darwin)
elseif(VCPKG_TARGET_IS_MINGW)
  set(ASPERITY_TARGET x86_64-pc-windows-gnu)
elseif(VCPKG_TARGET_ARCHITECTURE STREQUAL "arm64")
  set(ASPERITY_TARGET aarch64-unknown-linux-gnu)
else()
  set(ASPERITY_TARGET x86_64-unknown-linux-gnu)
endif()
set(ASPERITY_ENDING tar.gz)
if(VCPKG_TARGET_IS_MINGW)
  set(ASPERITY_ENDING zip)
endif()
set(ASPERITY_FILE "libasperity-${VERSION}-${ASPERITY_TARGET}.${ASPERITY_ENDING}")

vcpkg_download_distfile(ARCHIVE
  URLS "https://github.com/asperity-haptics/asperity/releases/download/v${VERSION}/${ASPERITY_FILE}"
  FILENAME "${ASPERITY_FILE}"
  SHA512 "${ASPERITY_SHA512}")
vcpkg_extract_source_archive(FOLDER ARCHIVE "${ARCHIVE}")

file(INSTALL "${FOLDER}/include/" DESTINATION "${CURRENT_PACKAGES_DIR}/include")
file(INSTALL "${FOLDER}/lib/cmake/Asperity/" DESTINATION "${CURRENT_PACKAGES_DIR}/share/cmake/Asperity")
file(INSTALL "${FOLDER}/lib/pkgconfig" DESTINATION "${CURRENT_PACKAGES_DIR}/lib")
if(VCPKG_LIBRARY_LINKAGE STREQUAL "static")
  file(INSTALL "${FOLDER}/lib/libasperity.a" DESTINATION "${CURRENT_PACKAGES_DIR}/lib")
else()
  file(GLOB SHARED "${FOLDER}/lib/libasperity.so*" "${FOLDER}/lib/libasperity*.dylib" "${FOLDER}/lib/*.dll.a")
  file(INSTALL ${SHARED} DESTINATION "${CURRENT_PACKAGES_DIR}/lib")
  if(VCPKG_TARGET_IS_MINGW)
    file(INSTALL "${FOLDER}/bin/" DESTINATION "${CURRENT_PACKAGES_DIR}/bin")
  endif()
endif()
# One archive serves debug and release.
set(VCPKG_BUILD_TYPE release)
vcpkg_install_copyright(FILE_LIST "${FOLDER}/LICENSE-MIT" "${FOLDER}/LICENSE-APACHE" "${FOLDER}/THIRD-PARTY.txt")
