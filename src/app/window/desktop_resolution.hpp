#pragma once

namespace quadrille::app {

/// The resolution that an X11 desktop wants text to be made for ("Xft.dpi"), in dots per inch; 96
/// where it has no wish.
double desktopDotsPerInch();

}  // namespace quadrille::app
