#pragma once

#include "bench/report_plan.hpp"
#include "bench/table.hpp"

namespace quadrille::bench {

/// Error of each law, precision and dt on each scene. The answer does not depend on the partitioner
/// (for `baseline` it does a little: its own is the quadtree here), so it is measured once.
Table measureErrors(const ReportPlan& plan);

/// Speed of each law, precision and dt on each partitioner. Throws Error if complete partitioners
/// end in different states under a law that promises one answer.
Table measureSpeeds(const ReportPlan& plan);

/// The semi-static tree with a skin, and rebuilt every K steps without one: time and missed pairs.
Table measurePolicies(const ReportPlan& plan);

/// What a feature of a scene costs in bytes and time.
Table measureFeatures(const ReportPlan& plan);

}  // namespace quadrille::bench
