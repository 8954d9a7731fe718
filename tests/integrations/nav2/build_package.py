"""Does the package's CMakeLists.txt build the plugin with the forms in which releases of ROS export packages?

usage: build_package.py CMAKE CXX ROOT WORK EIGEN_INCLUDE RELEASE STUB_FOLDER...

The packages are stubs: they have the variables or targets of the real ones, and the stub headers of the other tests.
"""
import json
import os
import re
import shutil
import subprocess
import sys

PACKAGES = ['geometry_msgs', 'nav2_core', 'nav2_costmap_2d', 'nav_msgs', 'pluginlib', 'rclcpp', 'rclcpp_lifecycle', 'tf2_ros']
STANDARDS = {'humble': 17, 'jazzy': 17, 'rolling': 20}
WITHOUT_TARGETS = {'humble': ['nav2_core', 'pluginlib'], 'jazzy': ['nav2_core'], 'rolling': []}


def write_package(folder, name, text):
    os.makedirs(os.path.join(folder, name), exist_ok=True)
    with open(os.path.join(folder, name, f'{name}Config.cmake'), 'w', encoding='utf-8') as file:
        file.write(text)


def target(name, folders, definition=''):
    return (f'add_library({name} INTERFACE IMPORTED)\n'
            f'set_target_properties({name} PROPERTIES INTERFACE_INCLUDE_DIRECTORIES "{";".join(folders)}"'
            f' INTERFACE_COMPILE_DEFINITIONS "{definition}")\n')


def write_packages(folder, root, eigen, release, stubs):
    for name in PACKAGES:
        folders = stubs if name == 'nav2_core' else []
        if name in WITHOUT_TARGETS[release]:
            write_package(folder, name, f'set({name}_INCLUDE_DIRS "{";".join(folders)}")\nset({name}_LIBRARIES m)\n')
        else:
            write_package(folder, name, target(f'{name}::{name}', folders) + f'set({name}_TARGETS {name}::{name})\n')
    with open(os.path.join(folder, 'pluginlib', 'pluginlibConfig.cmake'), 'a', encoding='utf-8') as file:
        file.write('function(pluginlib_export_plugin_description_file)\nendfunction()\n')
    write_package(folder, 'ament_cmake', 'function(ament_package)\nendfunction()\n')
    # As in nav2_common: a default of the standard, and warnings as errors.
    write_package(folder, 'nav2_common', 'macro(nav2_package)\n  if(NOT CMAKE_CXX_STANDARD)\n'
                  f'    set(CMAKE_CXX_STANDARD {STANDARDS[release]})\n  endif()\n'
                  '  add_compile_options(-Wall -Wextra -Wpedantic -Werror -Wshadow -fPIC)\nendmacro()\n')
    write_package(folder, 'ompl_improved_astar', target('ompl_improved_astar::core', [root, eigen], f'NAV2_{release}'))


def main(cmake, compiler, root, work, eigen, release, *stubs):
    shutil.rmtree(work, ignore_errors=True)
    packages = os.path.join(work, 'packages')
    write_packages(packages, root, eigen, release, stubs)
    build = os.path.join(work, 'build')
    names = PACKAGES + ['ament_cmake', 'nav2_common', 'ompl_improved_astar']
    subprocess.run([cmake, '-S', os.path.join(root, 'integrations', 'nav2'), '-B', build, f'-DCMAKE_CXX_COMPILER={compiler}',
                    '-DCMAKE_EXPORT_COMPILE_COMMANDS=ON', '-DCMAKE_BUILD_TYPE=Debug']
                   + [f'-D{name}_DIR={os.path.join(packages, name)}' for name in names], check=True)
    with open(os.path.join(build, 'compile_commands.json'), encoding='utf-8') as file:
        for entry in json.load(file):
            # The standard of the compiler itself needs no option.
            standards = re.findall(r'-std=(?:gnu|c)[+][+](\d+)', entry['command']) or ['17']
            if standards != [str(STANDARDS[release])]:
                return f'{entry["file"]} is compiled as C++{standards}, not {STANDARDS[release]}'
    subprocess.run([cmake, '--build', build], check=True)
    return None


if __name__ == '__main__':
    sys.exit(main(*sys.argv[1:]))
