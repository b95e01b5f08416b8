#include <algorithm>
#include <cmath>
#include <imgui.h>
#include <string>

#include "app/window/panels.hpp"
#include "app/window/plot_canvas.hpp"
#include "app/window/text.hpp"
#include "app/window/theme.hpp"

namespace quadrille::app {

void showLoadPanel(const PanelContext& context) {
    if (!sectionHeader("Bodies per cell", "How many cells hold how many bodies; logarithmic.")) {
        return;
    }
    const LoadHistogram& histogram = context.measures.histogram;
    const std::size_t bins = histogram.cells.size();
    const std::string most = grouped(std::max<std::size_t>(histogram.most, 1));
    PlotCanvas canvas("load", float(56 * context.scale), most);
    if (bins == 0 || histogram.most == 0) {
        canvas.addCaption("no cells before the first step");
        return;
    }
    // Room for one cell, too: log(1 + n).
    const float top = std::log1p(float(histogram.most));
    canvas.addLine(0, "0");
    const float ceiling = 1 - (ImGui::GetFontSize() + 6) / canvas.height();  // below the caption
    canvas.addLine(ceiling, most);
    const float width = canvas.width() / float(bins);
    for (std::size_t k = 0; k < bins; ++k) {
        const float height =
            std::log1p(float(histogram.cells[k])) / top * ceiling * canvas.height();
        const float x = canvas.left() + float(k) * width;
        canvas.list().AddRectFilled({x + 0.5f, canvas.bottom() - height},
                                    {x + width - 0.5f, canvas.bottom()}, packed(theme.accent));
    }
    canvas.addCaption("0 to " + grouped(bins * histogram.binWidth - 1) + " bodies", true);
    if (const auto mouse = canvas.mouse()) {
        const std::size_t k = std::min(static_cast<std::size_t>(*mouse * float(bins)), bins - 1);
        const std::size_t first = k * histogram.binWidth, last = first + histogram.binWidth - 1;
        const std::string bodies =
            first == last ? grouped(first) : grouped(first) + " to " + grouped(last);
        ImGui::SetTooltip("%s cells with %s bodies", grouped(histogram.cells[k]).c_str(),
                          bodies.c_str());
    }
}

}  // namespace quadrille::app
