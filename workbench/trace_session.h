#pragma once
/** @file
Any trial of a session carried out again, for its report. */

#include "datasets/session/session_store.h"
#include "reports/session_views.h"

namespace graspbench {

/** Hands and objects are loaded once for all trials.
@throws Error when a hand or an object of the session is gone. */
TrialTracer MakeTrialTracer(const Session& session);

/** For a page that is made again: the same where the one before has 3-D views, else empty. Says on
the terminal when they cannot be kept. */
TrialTracer MakeKeptTracer(const Session& session);

}  // namespace graspbench
