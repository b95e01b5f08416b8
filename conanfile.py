import re

from conan import ConanFile
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import load


class Quadrille(ConanFile):
    name = 'quadrille'
    license = 'MIT'
    description = '2D rigid-box engine: one answer on every partitioner and device'
    package_type = 'library'
    settings = 'os', 'compiler', 'build_type', 'arch'
    options = {'shared': [True, False], 'fPIC': [True, False]}
    default_options = {'shared': False, 'fPIC': True}
    implements = ['auto_shared_fpic']
    exports_sources = ('CMakeLists.txt', 'LICENSE', 'cmake/*', 'cuda/*', 'include/*', 'scenes/*', 'src/*',
                       'tests/architectures/*')

    def set_version(self):
        text = load(self, f'{self.recipe_folder}/CMakeLists.txt')
        self.version = re.search(r'project\(quadrille VERSION ([0-9.]+)', text)[1]

    def requirements(self):
        self.requires('eigen/[>=3.3 <4]', transitive_headers=True)
        self.requires('tomlplusplus/[>=3.3 <4]')

    def validate(self):
        check_min_cppstd(self, 20)

    def layout(self):
        cmake_layout(self)

    def generate(self):
        toolchain = CMakeToolchain(self)
        for part in ('APP', 'TESTS', 'BENCH', 'EXAMPLES'):
            toolchain.cache_variables[f'QUADRILLE_{part}'] = False
        toolchain.generate()
        CMakeDeps(self).generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()

    def package_info(self):
        # find_package takes the package that is installed, not one that conan would make up.
        self.cpp_info.set_property('cmake_find_mode', 'none')
        self.cpp_info.builddirs = ['lib/cmake/quadrille']
