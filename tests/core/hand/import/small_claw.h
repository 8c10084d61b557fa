#pragma once
/** @file
A hand of two fingers and a thumb as MuJoCo models are written: degrees, another order of
Euler angles, nested classes, two joints on a body, joints beside their body's origin, every way to
give an orientation, a scene around it. */

#include <string>

#include "tests/core/hand/import/small_gripper.h"

namespace graspbench {

inline const char* const kSmallClaw = R"(<mujoco model="small claw">
  <compiler angle="degree" eulerseq="zYx" autolimits="true"/>
  <option timestep="0.002"/>
  <default>
    <joint axis="1 0 0" damping="0.02"/>
    <geom group="3"/>
    <default class="finger">
      <joint range="0 90"/>
      <geom type="capsule" size="0.008"/>
      <position kp="2" forcerange="-0.8 0.8"/>
      <default class="tip">
        <geom size="0.007" fromto="0 0 0 0 0 0.025"/>
        <joint range="0 80"/>
      </default>
    </default>
    <default class="thumb">
      <joint axis="-1 0 0" range="-10 70"/>
      <geom type="capsule" size="0.01"/>
    </default>
  </default>
  <worldbody>
    <geom type="plane" size="1 1 0.1"/>
    <body name="cube" pos="0.3 0 0.05">
      <freejoint/>
      <geom type="box" size="0.02 0.02 0.02" mass="0.1"/>
    </body>
    <body name="palm" pos="0.1 -0.2 0.4" euler="30 -20 10" childclass="finger">
      <freejoint name="float"/>
      <inertial mass="0.4" pos="0 0 0.03" fullinertia="4e-4 3e-4 2e-4 1e-5 0 0"/>
      <geom name="palm" type="box" size="0.04 0.012 0.04" pos="0 0 0.03"/>
      <body name="ff_proximal" pos="0.025 0 0.075" axisangle="0 1 0 5">
        <joint name="FFJ4" axis="0 1 0" range="-20 20" pos="0 0.002 -0.003"/>
        <joint name="FFJ3" pos="0 -0.001 0.002"/>
        <geom name="ff_proximal" fromto="0 0 0 0 0 0.04"/>
        <body name="ff_middle" pos="0 0 0.04" quat="2 0.02 0 0">
          <joint name="FFJ2"/>
          <geom name="ff_middle" fromto="0 0 0 0.001 0.002 0.028"/>
          <body name="ff_distal" pos="0 0 0.028">
            <joint name="FFJ1" class="tip"/>
            <geom name="ff_distal" class="tip"/>
          </body>
        </body>
      </body>
      <body name="mf_proximal" pos="-0.025 0 0.075" xyaxes="1 0.05 0 0.03 1 0.02">
        <joint name="MFJ3" ref="5" range="5 95"/>
        <geom name="mf_proximal" fromto="0 0 0 0 0 0.045"/>
        <body name="mf_middle" pos="0 0 0.045">
          <joint name="MFJ2" pos="0 0.003 0"/>
          <geom name="mf_middle" fromto="0 0 0 0 0 0.03"/>
          <body name="mf_distal" pos="0 0 0.03" euler="2 1 3">
            <joint name="MFJ1" class="tip"/>
            <geom name="mf_distal" class="tip"/>
          </body>
        </body>
      </body>
      <body name="th_slide" pos="0 -0.05 0.02" childclass="thumb" zaxis="0.1 -0.2 1">
        <joint name="THJ3" type="slide" axis="1 0 0" range="-0.01 0.02" pos="0.3 0.3 0.3"/>
        <geom name="th_slide" type="cylinder" size="0.012 0.01"/>
        <body name="th_proximal">
          <joint name="THJ2"/>
          <geom name="th_proximal" fromto="0 0 0 0 0 0.05"/>
          <body name="th_distal" pos="0 0 0.05">
            <joint name="THJ1"/>
            <geom name="th_distal" size="0.009" fromto="0 0 0 0 0 0.03"/>
          </body>
        </body>
      </body>
    </body>
  </worldbody>
  <tendon>
    <fixed name="FFJ0">
      <joint joint="FFJ2" coef="1"/>
      <joint joint="FFJ1" coef="1"/>
    </fixed>
  </tendon>
  <equality>
    <joint joint1="MFJ1" joint2="MFJ2" polycoef="0.1 0.8 0 0 0"/>
  </equality>
  <actuator>
    <position name="A_FFJ4" joint="FFJ4" class="finger"/>
    <position name="A_FFJ3" joint="FFJ3" class="finger"/>
    <position name="A_FFJ0" tendon="FFJ0" class="finger" kp="1"/>
    <position name="A_MFJ3" joint="MFJ3" class="finger" gear="2"/>
    <motor name="A_MFJ2" joint="MFJ2" gear="0.5" ctrlrange="-2 2" ctrllimited="true"/>
    <general name="A_THJ3" joint="THJ3" biastype="affine" gainprm="900" biasprm="0 -900 -30"
      forcerange="-25 25"/>
    <position name="A_THJ2" joint="THJ2" kp="1.5" forcerange="-0.5 0.6"/>
  </actuator>
</mujoco>
)";

inline HandSource MakeMjcfSource() {
  HandSource source = MakeSourceWithoutMeshes();
  source.file = "claw.xml";
  return source;
}

}  // namespace graspbench
