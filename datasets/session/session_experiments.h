#pragma once
/** @file
Experiments on a session: sessions in folders below it, `sensitivity/3f2a9c01` for instance, whose
trials repeat its draws under conditions of their own (workbench/experiments). Whoever compares the
two must know that they belong together: a folder that was copied from elsewhere fits by the names
of its draws alone. */

#include <string>
#include <vector>

#include "datasets/session/session.h"

namespace graspbench {

/** @param name  of the experiment's folder, from the session's.
@throws Error(kFormat) where it is of another session: of another configuration but for the number
of trials and the conditions, below schedules/ also the grasps. Another version of an object under
the same name is not noticed. */
void CheckIsExperimentOn(const Session& session, const Session& experiment,
                         const std::string& name);

/** Those in folders of one kind, in the order of their names, with brief records; none for a session
that stands in no folder. @throws as LoadSession, CheckIsExperimentOn. */
std::vector<Session> LoadExperiments(const Session& session, const std::string& kind);

}  // namespace graspbench
