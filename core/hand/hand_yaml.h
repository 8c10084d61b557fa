#pragma once
/** @file
hand.yaml: what a URDF cannot say about a hand. Lengths are in metres, in the frame stated.

    name: Three-finger Hand
    palm:
      link: palm
      centre_m: [0, 0, 0]      # centre of the palm's surface, in the palm's frame
      normal: [0, 0, 1]        # out of the palm, in the palm's frame
    joint_accuracy_deg: 2      # half-width of the per-trial uniform error of every drive
    slide_accuracy_mm: 0.5     # the same for prismatic joints; absent: 0
    pad_torsion_radius_m: 0.004   # of the links that carry the pads
    digits:                    # their order is that of the hand's joints
      - id: TH
        name: thumb
        thumb: true            # one digit
        links: [th_base, th_proximal, th_distal]   # from base to tip; the last carries the pad
        tip_m: [0, 0, 0.02]    # in the last link
        pad_m: [0.007, 0, 0.014]
    coupling:                  # absent: none
      rule: middle-first       # middle-first, even or fixed
      fixed_ratio: 0.8         # for the rule "fixed"
      joints: {THJ1: THJ2}     # distal joint: the middle joint that it follows
    mimic:                     # absent: none. Joints that a linkage couples to another joint
      - joint: FFJ3
        follows: MFJ3          # any joint with a drive
        ratio: -1.0            # q = ratio * q of that joint + offset, in radians and metres
        offset_deg: 0          # absent: 0. Prismatic: offset_mm
    drives:                    # every joint that is not coupled, once
      - joints: [THJ3, THJ2]
        stiffness_nm_per_rad: 3.0
        damping_nms_per_rad: 0.03
        torque_limit_nm: 1.0   # prismatic: stiffness_n_per_m, damping_ns_per_m, force_limit_n
    surfaces:                  # absent, or omitted keys: as in the session
      - links: [palm]
        contact_stiffness_n_per_m: 2e5   # of one contact point
        friction_static: 0.6             # combined with the object's: core/physics/contact.h
        friction_dynamic: 0.5
        torsion_radius_m: 0.002
    pads:                      # absent: none. Soft layers: core/physics/contact.h
      - links: [th_distal]
        youngs_modulus_pa: 1.1e6
        depth_m: 0.003         # greatest compression
        source: maker's data sheet, hardness 30 Shore A
    apart:                     # absent: none. Pairs of links that never touch each other
      - [palm, th_base]
    frames:                    # absent: none. Further frames of the description, for hand fk
      - name: th_tip
        link: th_distal
        position_m: [0, 0, 0.02]     # in the link
        rpy_rad: [0, 0, 0]           # absent: zero; as in a URDF
    camera:                    # absent: none. Not part of the hand's content hash
      link: palm
      position_m: [0, 0.1, 0.03]   # of the lens, in the link
      forward: [0, 0, 1]       # viewing direction, in the link
      right: [1, 0, 0]         # to the right of the image, in the link
      width_px: 640
      height_px: 480
      focal_length_px: 580
      radial_1: 0              # distortion, core/vision/camera_config.h
      radial_2: 0
    grasps: ...                # see core/grasp/standard_grasp.h */

#include <string>

#include "core/base/error.h"
#include "core/base/file_keys.h"
#include "core/hand/hand.h"
#include "core/hand/read_urdf.h"

namespace graspbench {

/** Fills palm_link, digits, coupling, drives and the scalars of `hand`, whose links and joints were
read from the URDF. Names are checked against `urdf`, so that all problems of hand.yaml are reported
even if the URDF is invalid. */
void ReadHandYaml(const std::string& text, const std::string& file, const Urdf& urdf, Hand& hand,
                  Diagnostics& problems);

/** The keys of hand.yaml except those of its grasps (core/grasp/grasp_yaml.h). */
const FileKeys& ListHandKeys();

}  // namespace graspbench
