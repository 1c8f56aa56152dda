"""Conan 2 recipe: the C library as packages/build has packed it; no Rust is needed.

    packages/conan/checksums DIR [URL]        writes conandata.yml: archives of DIR, which lie at URL, or in DIR itself
    conan create packages/conan --version 0.1.0 [-o asperity/*:shared=True]
"""

from pathlib import Path

from conan import ConanFile
from conan.errors import ConanInvalidConfiguration
from conan.tools.files import copy, get, rm, rmdir


class Asperity(ConanFile):
    name = "asperity"
    description = "Haptic textures, rendered at 1 kHz without allocation"
    license = "MIT OR Apache-2.0"
    url = "https://github.com/asperity-haptics/asperity"
    topics = ("haptics", "texture", "real-time")
    package_type = "library"
    settings = "os", "arch", "compiler", "build_type"
    options = {"shared": [True, False]}
    default_options = {"shared": False}

    def archive(self):
        """What conandata.yml says of this system's archive; None if there is none."""
        system = {"Macos": "apple-darwin", "Linux": "unknown-linux-gnu", "Windows": "pc-windows-gnu"}
        arch = {"armv8": "aarch64"}.get(str(self.settings.arch), str(self.settings.arch))
        triple = f"{arch}-{system.get(str(self.settings.os))}"
        return self.conan_data["sources"].get(self.version, {}).get(triple)

    def package_id(self):
        # One archive serves every build type, and every compiler of its system.
        del self.info.settings.build_type
        del self.info.settings.compiler

    def validate(self):
        if self.settings.os == "Windows" and self.settings.compiler == "msvc":
            raise ConanInvalidConfiguration("the archive for Windows is for MinGW; lib/asperity.def serves MSVC by hand")
        if self.archive() is None:
            raise ConanInvalidConfiguration(f"no archive of {self.version} for {self.settings.os} on {self.settings.arch}")

    def build(self):
        get(self, **self.archive(), strip_root=True)

    def package(self):
        here, there = self.build_folder, self.package_folder
        for licence in ("LICENSE-*", "THIRD-PARTY.txt", "sbom.cdx.json"):
            copy(self, licence, here, Path(there) / "licenses")
        for folder in ("include", "lib", "bin"):
            copy(self, "*", Path(here) / folder, Path(there) / folder)
        # Conan writes files of its own for pkg-config and CMake, from what is below.
        self.system_libs = self.private_libraries(Path(there) / "lib" / "pkgconfig" / "asperity.pc")
        rmdir(self, str(Path(there) / "lib" / "pkgconfig"))
        rmdir(self, str(Path(there) / "lib" / "cmake"))
        for unwanted in ["libasperity.a"] if self.options.shared else ["*.so*", "*.dylib", "*.dll*", "*.def"]:
            rm(self, unwanted, there, recursive=True)
        (Path(there) / "licenses" / "system_libs").write_text(" ".join(self.system_libs) + "\n")

    @staticmethod
    def private_libraries(pc):
        """Libraries of the system that the static library needs."""
        line = next(line for line in pc.read_text().splitlines() if line.startswith("Libs.private:"))
        return [word[2:] for word in line.split() if word.startswith("-l")]

    def package_info(self):
        self.cpp_info.set_property("cmake_file_name", "Asperity")
        self.cpp_info.set_property("cmake_target_name", "Asperity::asperity")
        self.cpp_info.set_property("pkg_config_name", "asperity")
        self.cpp_info.libs = ["asperity"]
        if not self.options.shared:
            # Without what no call reaches, most of Rust's standard library.
            collect = "-Wl,-dead_strip" if self.settings.os == "Macos" else "-Wl,--gc-sections"
            self.cpp_info.exelinkflags = self.cpp_info.sharedlinkflags = [collect]
            needed = (Path(self.package_folder) / "licenses" / "system_libs").read_text()
            self.cpp_info.system_libs = needed.split()
