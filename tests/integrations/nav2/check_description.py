"""Do the code, the plugin description and the package of the nav2 plugin name the same class, files and version?

usage: check_description.py FOLDER VERSION
"""
import os
import re
import sys
import xml.etree.ElementTree as xml


def main(folder, version):
    def text_of(name):
        with open(os.path.join(folder, name), encoding='utf-8') as file:
            return file.read()
    faults = []
    described = xml.parse(os.path.join(folder, 'global_planner_plugin.xml')).getroot()
    package = xml.parse(os.path.join(folder, 'package.xml')).getroot()
    cmake = text_of('CMakeLists.txt')
    exported = re.search(r'PLUGINLIB_EXPORT_CLASS\((\S+), (\S+)\)', text_of('ImprovedAStarPlanner.cpp'))
    one = described.find('class')
    if (one.get('type'), one.get('base_class_type')) != exported.groups():
        faults.append(f'the description has {one.attrib}, the code exports {exported.groups()}')
    if package.find('version').text != version:
        faults.append(f'package.xml has version {package.find("version").text}, the project {version}')
    # ROS's tools ignore a file whose address has no domain.
    if not re.fullmatch(r'[\w%+.-]+@[\w-]+(\.[\w-]+)*\.[a-zA-Z]{2,}', package.find('maintainer').get('email')):
        faults.append('package.xml: the maintainer has no valid e-mail address')
    name = package.find('name').text
    if f'project({name} ' not in cmake or f'add_library({described.get("path")} ' not in cmake:
        faults.append(f'CMakeLists.txt builds no {name} with a library {described.get("path")}')
    if package.find('export').find('nav2_core').get('plugin') != '${prefix}/global_planner_plugin.xml':
        faults.append('package.xml exports another description')
    needed = sorted(each.text for each in package.findall('depend'))
    found = re.search(r'set\(dependencies ([^)]*)\)', cmake).group(1).split()
    found += [name for name in re.findall(r'find_package\((\w+) REQUIRED', cmake) if name not in ('ament_cmake', 'nav2_common')]
    found.sort()
    if needed != found:
        faults.append(f'package.xml depends on {needed}, CMakeLists.txt finds {found}')
    for source in [entry for entry in os.listdir(folder) if entry.endswith('.cpp')]:
        if source not in cmake:
            faults.append(f'CMakeLists.txt does not build {source}')
    return '\n'.join(faults) or None


if __name__ == '__main__':
    sys.exit(main(*sys.argv[1:]))
