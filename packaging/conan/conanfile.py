"""Conan 2 recipe of the library and, where asked for, the program."""

from conan import ConanFile
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy, rm, rmdir
import os

# Option: CMake's name of it, and what it needs.
PARTS = {
    "with_zlib": ("ZLIB", "zlib/[>=1.2.11 <2]"),
    "with_expat": ("EXPAT", "expat/[>=2.6 <3]"),
    "with_lz4": ("LZ4", "lz4/[>=1.9 <2]"),
    "with_lzma": ("LZMA", "xz_utils/[>=5.4 <6]"),
    "with_libzip": ("LIBZIP", "libzip/[>=1.7 <2]"),
    "with_draco": ("DRACO", "draco/1.5.6"),
    "with_meshoptimizer": ("MESHOPTIMIZER", "meshoptimizer/0.20"),
    "with_webp": ("WEBP", "libwebp/[>=1.2 <2]"),
    "with_eigen": ("EIGEN", "eigen/[>=3.4 <4]"),
}


class Brushfire(ConanFile):
    name = "brushfire"
    license = "MIT"
    description = "Geodesic distances and shortest paths on triangle meshes"
    topics = ("geodesic", "mesh", "shortest-path", "geometry-processing")
    package_type = "library"
    settings = "os", "arch", "compiler", "build_type"
    options = {"shared": [True, False], "fPIC": [True, False], "tools": [True, False]} | {
        part: [True, False] for part in PARTS
    }
    default_options = {"shared": False, "fPIC": True, "tools": False} | {part: part != "with_webp" for part in PARTS}
    implements = ["auto_shared_fpic"]

    def export_sources(self):
        root = os.path.join(self.recipe_folder, "..", "..")
        for pattern in ("CMakeLists.txt", "LICENSE", "cmake/*", "src/*", "tools/brushfire/*"):
            copy(self, pattern, root, self.export_sources_folder)

    def validate(self):
        check_min_cppstd(self, 20)

    def layout(self):
        cmake_layout(self)

    def requirements(self):
        for header_only in ("boost/[>=1.74 <2]", "fast_float/[>=6 <9]", "nlohmann_json/[>=3.11 <4]", "stb/cci.20240531"):
            self.requires(header_only, headers=True, libs=False)
        if self.options.tools:
            self.requires("cli11/[>=2.4 <3]")
        for part, (_, reference) in PARTS.items():
            if self.options.get_safe(part):
                self.requires(reference)

    def generate(self):
        CMakeDeps(self).generate()
        toolchain = CMakeToolchain(self)
        for part, (name, _) in PARTS.items():
            toolchain.cache_variables[f"BRUSHFIRE_WITH_{name}"] = bool(self.options.get_safe(part))
        toolchain.cache_variables |= {
            "BRUSHFIRE_BUILD_TOOLS": bool(self.options.tools),
            "BRUSHFIRE_BUILD_TESTS": False,
            "BRUSHFIRE_WITH_EMBREE": False,
        }
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))
        rmdir(self, os.path.join(self.package_folder, "lib", "cmake"))
        rmdir(self, os.path.join(self.package_folder, "lib", "pkgconfig"))
        rm(self, "*.pdb", self.package_folder, recursive=True)

    def package_info(self):
        self.cpp_info.libs = ["brushfire"]
        self.cpp_info.set_property("cmake_file_name", "brushfire")
        self.cpp_info.set_property("cmake_target_name", "brushfire::brushfire")
        self.cpp_info.set_property("pkg_config_name", "brushfire")
        if self.settings.os in ("Linux", "FreeBSD"):
            self.cpp_info.system_libs = ["pthread", "m"]
