"""Damaged and malicious descriptions of hands in XML: URDF, MJCF, and COLLADA of a link."""
import copy, re, sys
import xml.etree.ElementTree as xml
from lies import cut, words, write

ENTITIES = '<!DOCTYPE r [' + '<!ENTITY a0 "ha">' + ''.join('<!ENTITY a%d "%s">' % (i, ('&a%d;' % (i - 1)) * 10) for i in range(1, 12)) + '<!ENTITY file SYSTEM "file:///etc/passwd">]>'


def change_xml(r, root):
    nodes = list(root.iter())
    node = r.choice(nodes)
    kind = r.randrange(8)
    if kind <= 2 and node.attrib:
        key = r.choice(list(node.attrib))
        old = node.attrib[key]
        parts = old.split()
        if len(parts) > 1 and r.random() < 0.7:
            parts[r.randrange(len(parts))] = words(r)
            node.attrib[key] = ' '.join(parts)
        else:
            node.attrib[key] = r.choice([words(r), r.choice(list(r.choice(nodes).attrib.values()) or ['']), ' '.join([words(r)] * 40)])
    elif kind == 3 and len(node):
        child = r.choice(list(node))
        for _ in range(r.choice([1, 3, 400])):
            node.append(copy.deepcopy(child))
    elif kind == 4 and len(node):
        node.remove(r.choice(list(node)))
    elif kind == 5:
        deep = node
        for _ in range(r.choice([5, 300, 5000])):
            deep = xml.SubElement(deep, r.choice(nodes).tag if r.random() < 0.01 else node.tag)
    elif kind == 6:
        node.text = r.choice([words(r), ' '.join(words(r) for _ in range(50)), '1 ' * 50000])
    else:
        node.append(copy.deepcopy(root) if r.random() < 0.3 else copy.deepcopy(r.choice(nodes)))
        if node.attrib:
            node.attrib.pop(r.choice(list(node.attrib)))


def xml_bytes(r, root):
    for element in root.iter():  # control characters are not XML
        element.attrib = {k: re.sub('[\x00-\x08\x0b-\x1f]', '?', v) for k, v in element.attrib.items()}
        if element.text:
            element.text = re.sub('[\x00-\x08\x0b-\x1f]', '?', element.text)
    sys.setrecursionlimit(100000)
    text = xml.tostring(root, encoding='unicode')
    if r.random() < 0.1:
        at = text.find('"') + 1
        text = ENTITIES + text[:at] + r.choice(['&a11;', '&file;', '&#0;', '&#x110000;', '&unknown;']) + text[at:]
    data = text.encode('utf-8', 'replace')
    return cut(r, data) if r.random() < 0.1 else data


def small_hand(cases):
    """The valid hand at a third of its size, which is imported in a tenth of the time."""
    root = xml.fromstring((cases / 'hand_import/good.urdf').read_text())
    for node in root.iter():
        for key in ('size', 'xyz', 'lower', 'upper'):
            if key in node.attrib and node.tag != 'axis':
                node.attrib[key] = ' '.join('%g' % (0.3 * float(v)) for v in node.attrib[key].split())
        if node.tag == 'mass':
            node.attrib['value'] = '%g' % (0.027 * float(node.attrib['value']))
        if node.tag == 'inertia':
            node.attrib.update({key: '%g' % (0.00243 * float(value)) for key, value in node.attrib.items()})
    return root


def urdf(r, cases, folder):
    root = small_hand(cases)
    for _ in range(r.randint(1, 3)):
        change_xml(r, root)
    return write(folder, 'mutant.urdf', xml_bytes(r, root))


MJCF = '''<mujoco model="pinch"><compiler angle="degree" autolimits="true"/><option timestep="0.002"/>
<default><geom density="1200" type="capsule"/><default class="jaw"><joint axis="1 0 0" range="0 60"/><geom size="0.004"/></default></default>
<asset><mesh name="pad" vertex="0 0 0 0.006 0 0 0 0.004 0 0 0 0.004"/></asset>
<worldbody><light pos="0 0 3"/><geom type="plane" size="1 1 0.1"/>
<body name="palm" pos="0 0 0.3" quat="1 0 0 0"><freejoint/><inertial mass="0.05" pos="0 0 0.01" diaginertia="2e-5 2e-5 1e-5"/>
<geom type="box" size="0.015 0.015 0.008" pos="0 0 0.008"/>
<body name="left" pos="0 0.014 0.016" childclass="jaw"><joint name="a"/><geom fromto="0 0 0 0 0 0.02"/>
<body name="left_tip" pos="0 0 0.02"><joint name="b" range="0 45"/><geom fromto="0 0 0 0 0 0.015" mass="0.004"/></body></body>
<body name="right" pos="0 -0.014 0.016" euler="0 0 180" childclass="jaw"><joint name="c"/><geom fromto="0 0 0 0 0 0.02"/>
<body name="right_tip" pos="0 0 0.02"><joint name="d" range="0 45"/><geom fromto="0 0 0 0 0 0.015" mass="0.004"/><site name="s" pos="0 0 0.01"/></body></body></body></worldbody>
<equality><joint joint1="b" joint2="a" polycoef="0 1 0 0 0"/></equality>
<tendon><fixed name="t"><joint joint="c" coef="1"/><joint joint="d" coef="1"/></fixed></tendon>
<actuator><position name="pa" joint="a" kp="1" forcerange="-0.4 0.4" ctrlrange="0 60"/><position tendon="t" kp="1" forcerange="-0.4 0.4"/></actuator></mujoco>'''


def mjcf(r, cases, folder):
    own = [p for p in sorted(cases.glob('hand_import/*')) if p.read_bytes().lstrip().startswith(b'<mujoco')]
    root = xml.fromstring(MJCF if r.random() < 0.9 else r.choice(own).read_text())
    for _ in range(r.randint(1, 3)):
        change_xml(r, root)
    if r.random() < 0.15:
        xml.SubElement(root, 'include', {'file': r.choice(['mutant.xml', '/etc/passwd', '../x.xml', 'loop.xml', '/dev/zero', ''])})
        (folder / 'loop.xml').symlink_to('loop.xml') if not (folder / 'loop.xml').is_symlink() else None
    return write(folder, 'mutant.xml', xml_bytes(r, root))


COLLADA = '''<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset><unit name="meter" meter="1"/><up_axis>Z_UP</up_axis></asset>
<library_geometries><geometry id="g"><mesh><source id="p"><float_array id="pa" count="12">0 0 0 0.008 0 0 0 0.006 0 0 0 0.01</float_array>
<technique_common><accessor source="#pa" count="4" stride="3"><param name="X" type="float"/><param name="Y" type="float"/><param name="Z" type="float"/></accessor></technique_common></source>
<vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
<triangles count="4"><input semantic="VERTEX" source="#v" offset="0"/><p>0 2 1 0 1 3 1 2 3 2 0 3</p></triangles></mesh></geometry></library_geometries>
<library_visual_scenes><visual_scene id="s"><node id="n"><matrix>1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1</matrix><instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>
<scene><instance_visual_scene url="#s"/></scene></COLLADA>'''


def collada(r, cases, folder):
    """A hand whose link has the mutant as picture and shape."""
    xml.register_namespace('', 'http://www.collada.org/2005/11/COLLADASchema')
    root = xml.fromstring(COLLADA)
    for _ in range(r.randint(1, 3)):
        change_xml(r, root)
    write(folder, 'mutant.dae', xml_bytes(r, root))
    hand = small_hand(cases)
    part = xml.SubElement(hand.findall('link')[r.randrange(1, 4)], r.choice(['collision', 'visual', 'visual']))
    xml.SubElement(xml.SubElement(part, 'geometry'), 'mesh', {'filename': 'mutant.dae'})
    return write(folder, 'mutant.urdf', xml.tostring(hand))
