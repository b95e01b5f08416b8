#pragma once

namespace quadrille {

/// Four boxes that stand still, one of them static, and a fifth that moves to the right.
inline constexpr const char* stillScene = R"(
format = 1
name = "still"
[world]
size = [200, 100]
[step]
dt = 0.015625
[[body]]
position = [-60, 30]
size = [20, 20]
color = "#ff0000"
[[body]]
position = [60, 30]
size = [20, 20]
color = "#00ff00"
[[body]]
position = [60, -30]
size = [30, 10]
static = true
color = "#0000ff"
[[body]]
position = [-60, -30]
size = [2, 2]
color = "#ffff00"
[[body]]
position = [0, 0]
size = [10, 10]
velocity = [64, 0]
color = "#ff00ff"
)";
inline constexpr double stillWidth = 200, stillHeight = 100;

}  // namespace quadrille
