#pragma once
/** @file
Course of a person's reach on a robot hand that took the grasp over (core/grasp/grasp_course.h).

    hand    follows the midpoint of the opening axis (thumb to the mean of the fingers), relative to
            its position at contact, from the grasp's approach distance on; its orientation stays
    digits  s = s* (1 - e o / |o|^2): e is the digit's displacement from its contact in the person's
            hand (CalcDigitOpenings), o the same at the widest opening, s* the closing at contact. A
            virtual finger has the mean e and o of the digits that it represents. Of a digit that
            opens by less than 5 mm, the distance of thumb and fingers replaces e and o

Closure starts at the person's widest opening. After the last contact the digits close at the speed
of the strategy. Proposed by graspbench. Not modelled: rotation of the person's hand. */

#include <string>

#include "core/grasp/grasp_course.h"
#include "core/transfer/transfer_grasp.h"

namespace graspbench {

struct PlayedReach {
  std::string not_played;  ///< the reason: the reach was not recorded, or the hand would collide
  GraspCourse course;      ///< then unset
};

/** @param found  transferable, of the same person, hand and object. */
PlayedReach PlayReach(const Hand& hand, const TransferredGrasp& found, const PersonGrasp& person,
                      const GraspObject& object);

}  // namespace graspbench
