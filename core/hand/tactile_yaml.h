#pragma once
/** @file
What a hand feels with, from tactile.yaml beside its hand.yaml (absent: nothing):

    response: exponential      # of each element to its force: exponential or linear
    surfaces:
      - link: ffdistal
        palmar: [0, -1, 0]     # only the side whose normal has a part along it; absent: all round
        along: [0, 0, 1]       # and only what lies beyond from_m in this direction; absent: all
        from_m: -0.001
        elements:
          - {position_m: [0, -0.007, 0.01], normal: [0, -1, 0], area_m2: 1.4e-5}

Frames: L of the link; SI. Directions need no length. */

#include <string>

#include "core/base/diagnostics.h"
#include "core/base/file_keys.h"
#include "core/hand/tactile.h"

namespace graspbench {

/** Every key of tactile.yaml, a line each. */
const FileKeys& ListTactileKeys();

/** From the text of a tactile.yaml; `file` is its name in messages. */
TactileSkin ParseTactile(const std::string& text, const std::string& file, const Hand& hand,
                         Diagnostics& problems);

}  // namespace graspbench
