# SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
# SPDX-License-Identifier: BSD-3-Clause
"""ParaView finds the plugin by PV_PLUGIN_PATH; every proxy is documented, and its defaults are
those of its C++ class."""
import pathlib
import sys
import xml.etree.ElementTree as ElementTree

from paraview import servermanager, simple

import trivariate

source = pathlib.Path(sys.argv[1])


def cxx_defaults(cls_object, command):
    """The value behind the setter `command` of a fresh C++ object as a list; None without getter."""
    getter = getattr(cls_object, command.replace("Set", "Get", 1), None)
    if getter is None:
        return None
    value = getter()
    return list(value) if isinstance(value, (tuple, list)) else [value]


compared = 0
for file in sorted((source / "Plugin").glob("*.xml")):
    for group in ElementTree.parse(file).getroot().iter("ProxyGroup"):
        for definition in group:
            where = definition.get("class") + ": "
            proxy = servermanager.ProxyManager().NewProxy(group.get("name"), definition.get("name"))
            assert proxy, where + "not known to ParaView"
            text = definition.find("Documentation")
            assert text is not None and text.text.strip() and text.get("short_help"), where + "no help"
            cls_object = getattr(trivariate, definition.get("class"))()
            for prop in definition:
                name = prop.get("name")
                if not prop.tag.endswith("Property") or prop.get("panel_visibility") == "never":
                    continue
                assert prop.find("Documentation") is not None, where + name + " is not documented"
                # ParaView's widget for strings of a list holds one, and takes the others away.
                has_list = prop.find("StringListDomain") is not None
                assert not (prop.get("repeat_command") and has_list), \
                    where + name + " has no widget"
                assert prop.tag != "IdTypeVectorProperty" or prop.get("information_only"), \
                    where + name + " has no widget"
                if prop.tag == "InputProperty" or not prop.get("command").startswith("Set"):
                    continue
                expected = cxx_defaults(cls_object, prop.get("command"))
                if expected is None:
                    continue
                helper = servermanager.vtkSMPropertyHelper(proxy, name)
                proxied = [helper.GetAsDouble(i) if not isinstance(expected[0], str)
                           else helper.GetAsString(i) for i in range(helper.GetNumberOfElements())]
                assert len(proxied) == len(expected) and all(
                    a == b or (a in ("", None) and b in ("", None))
                    for a, b in zip(proxied, expected)), \
                    f"{where}{name} is {proxied} in the proxy and {expected} in C++"
                compared += 1
assert compared >= 4, compared
print(compared, "defaults compared")
