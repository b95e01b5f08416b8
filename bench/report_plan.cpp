#include "bench/report_plan.hpp"

namespace quadrille::bench {

ReportPlan fullReport() {
    const std::string folder = QUADRILLE_BENCH_SCENES_DIR;
    ReportPlan plan;
    plan.scenes = {
        {.name = "balanced",
         .file = folder + "/balanced-shaken.toml",
         .entities = {},
         .errorFrames = 90},
        {.name = "demo13k",
         .file = folder + "/demo13k-shaken.toml",
         .entities = {},
         .errorFrames = 36},
        {.name = "dense1600",
         .file = QUADRILLE_GOLDEN_DIR "/dense1600.toml",
         .entities = {},
         .errorFrames = 4},
        // A body has seven collisions in two frames; a discrete law cannot have fewer frames.
        {.name = "imbalanced-clear", .file = "imbalanced-clear", .entities = {}, .errorFrames = 2},
        {.name = "imbalanced", .file = "imbalanced", .entities = {}},
    };
    return plan;
}

ReportPlan quickReport() {
    ReportPlan plan = fullReport();
    plan.scenes[0].errorFrames = 12;
    plan.scenes[1].errorFrames = 12;
    for (ReportScene& scene : plan.scenes) scene.speedFrames = 3;
    plan.rates = {60, 240, 960};
    plan.policies = {2, 10, 50};
    plan.repeats = 1;
    plan.policyFrames = 60;
    plan.featureBodies = 5'000;
    plan.featureFrames = 50;
    return plan;
}

}  // namespace quadrille::bench
