"""scripts/check-layers holds on this tree, and names the line where a copy of it is broken."""
import os
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), '..', '..'))
FOLDERS = ('include', 'src', 'cuda', 'bench', 'examples', 'tests')


def check(root):
    return subprocess.run([sys.executable, os.path.join(ROOT, 'scripts', 'check-layers'), root],
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


class Layers(unittest.TestCase):
    def test_this_tree(self):
        result = check(ROOT)
        self.assertEqual(result.returncode, 0, '\n' + result.stdout)


class Planted(unittest.TestCase):
    """Each test breaks a copy of the tree by one line."""

    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.root = self.folder.name
        for folder in FOLDERS:
            shutil.copytree(os.path.join(ROOT, folder), os.path.join(self.root, folder),
                            ignore=shutil.ignore_patterns('data', 'results', 'build'))
        self.before = check(self.root).stdout.splitlines()

    def plant(self, path, text):
        """Appends a line to a file, which may be new, and returns its number."""
        path = os.path.join(self.root, path)
        os.makedirs(os.path.dirname(path), exist_ok=True)
        with open(path, 'a+', encoding='utf-8') as file:
            file.seek(0)
            number = file.read().count('\n') + 1
            file.write(text + '\n')
        return number

    def expect(self, path, line, text, also=''):
        number = self.plant(path, line)
        result = check(self.root)
        self.assertEqual(result.returncode, 1, result.stdout)
        new = [said for said in result.stdout.splitlines() if said not in self.before]
        self.assertTrue(new and new[0].startswith(f'{path}:{number}: {text}'), new)
        self.assertEqual(bool(also), len(new) > 1, new)
        self.assertTrue(all(also in said for said in new[1:]), new)

    def test_core_knows_no_engine(self):
        self.plant('src/engines/planted.hpp', '#pragma once')
        self.expect('src/core/world.cpp', '#include "engines/planted.hpp"',
                    '"engines/planted.hpp" is of engines; core may include core, ')

    def test_laws_do_not_know_each_other(self):
        self.plant('src/collision/discrete/planted.hpp', '#pragma once')
        self.expect('src/collision/continuous/planted.cpp',
                    '#  include "collision/discrete/planted.hpp"',
                    '"collision/discrete/planted.hpp" is of discrete; continuous may include')

    def test_rules_take_only_what_a_kernel_can(self):
        self.expect('src/collision/rules/pair_contact.hpp', '#include <vector>', '<vector>: rules')

    def test_what_rules_include_is_as_plain(self):
        self.expect('include/quadrille/body_ref.hpp', '#include <string>', '<string>: vocabulary')

    def test_public_headers_bring_nothing_from_inside(self):
        self.plant('src/parallel/planted.hpp', '#pragma once')
        self.expect('include/quadrille/world.hpp', '#include "parallel/planted.hpp"',
                    '"parallel/planted.hpp" is of parallel; public')

    def test_public_headers_bring_no_library(self):
        self.expect('include/quadrille/world.hpp', '#include <toml++/toml.h>',
                    '<toml++/toml.h>: public')

    def test_the_program_uses_what_users_have(self):
        self.plant('src/core/planted.hpp', '#pragma once')
        self.expect('src/app/main.cpp', '#include "core/planted.hpp"',
                    '"core/planted.hpp" is of core; app')

    def test_the_reference_shares_only_the_vector(self):
        self.expect('src/reference/oracle.hpp', '#include <quadrille/world.hpp>',
                    '<quadrille/world.hpp> is of public; reference')

    def test_sources_do_not_include_tests(self):
        self.plant('tests/planted.hpp', '#pragma once')
        self.expect('bench/micro.cpp', '#include "../tests/planted.hpp"',
                    '"../tests/planted.hpp" is of tests; bench')

    def test_every_file_has_a_row(self):
        self.plant('src/collision/planted/planted.cpp', '')
        new = set(check(self.root).stdout.splitlines()) - set(self.before)
        self.assertEqual(new, {'src/collision/planted/planted.cpp:1: '
                               'is in no row of the table in scripts/check-layers'})

    def test_every_row_has_a_file(self):
        os.remove(os.path.join(self.root, 'include/quadrille/cell_coordinates.hpp'))
        self.assertIn('scripts/check-layers:1: has a row for include/quadrille/cell_coordinates.hpp, '
                      'which is not there', check(self.root).stdout.splitlines())

    def test_an_included_file_exists(self):
        self.expect('tests/core/world_test.cpp', '#include <quadrille/planted.hpp>',
                    '<quadrille/planted.hpp> is no file of the tree')

    def test_folders_include_each_other_in_one_direction(self):
        self.plant('src/app/window/planted.hpp', '#include "app/options.hpp"')
        self.expect('src/app/options.hpp', '#include "app/window/planted.hpp"',
                    'closes a circle of folders: ', also='closes a circle of folders: ')

    def test_the_device_compiles_every_rule(self):
        self.plant('src/collision/rules/planted.hpp', '#pragma once')
        new = set(check(self.root).stdout.splitlines()) - set(self.before)
        self.assertEqual(len(new), 1, new)
        self.assertTrue(new.pop().endswith('does not include src/collision/rules/planted.hpp'))


if __name__ == '__main__':
    unittest.main()
