#pragma once

namespace quadrille {

/// The numbers of a step that a contact law uses.
template <class Real>
struct StepParameters {
    double start;  ///< s since the start of the run
    Real dt;
    Real gravityX, gravityY;
    Real restitution;
};

}  // namespace quadrille
