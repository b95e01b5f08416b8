#include <imgui.h>
#include <string>

#include "app/window/keys.hpp"
#include "app/window/panels.hpp"
#include "app/window/text.hpp"
#include "app/window/theme.hpp"

namespace quadrille::app {

namespace {

constexpr ImGuiWindowFlags fixedWindow = ImGuiWindowFlags_NoCollapse |
                                         ImGuiWindowFlags_AlwaysAutoResize |
                                         ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize;

void row(const char* name, const std::string& value) {
    ImGui::TableNextColumn();
    ImGui::TextDisabled("%s", name);
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(value.c_str());
}

void showComponents(const World& world, Entity entity) {
    if (!ImGui::BeginTable("components", 2)) return;
    if (world.has<Transform>(entity)) {
        const Vec2 p = world.get<Transform>(entity).position;
        row("position, px", formatted("%.6g, %.6g", p.x(), p.y()));
    }
    if (world.has<BoxCollider>(entity)) {
        const Vec2 s = world.get<BoxCollider>(entity).size;
        row("size, px", formatted("%.6g x %.6g", s.x(), s.y()));
    }
    if (world.has<PhysicsBody>(entity)) {
        const PhysicsBody body = world.get<PhysicsBody>(entity);
        if (body.isStatic) {
            row("body", "static");
        } else {
            row("velocity, px/s", formatted("%.6g, %.6g", body.velocity.x(), body.velocity.y()));
            row("speed, px/s", formatted("%.6g", body.velocity.norm()));
            row("mass", formatted("%.6g", body.mass));
        }
    }
    if (world.has<RectangleRenderer>(entity)) {
        const Color c = world.get<RectangleRenderer>(entity).color;
        row("colour", formatted("#%02x%02x%02x", c.r, c.g, c.b));
    }
    ImGui::EndTable();
}

std::string label(const World& world, Entity entity) {
    const std::string_view name = world.name(entity);
    const std::string number = std::to_string(entity.index);
    return name.empty() ? number : number + " " + std::string(name);
}

void showContacts(const Workbench& bench, Entity entity) {
    ImGui::TextDisabled("contacts of the last step");
    constexpr int mostRows = 8;
    int rows = 0;
    for (const Contact& contact : bench.contacts()) {
        if (contact.a != entity && contact.b != entity) continue;
        if (++rows > mostRows) continue;
        const Entity other = contact.a == entity ? contact.b : contact.a;
        const char* axis = contact.axis == Axis::X   ? "x"
                           : contact.axis == Axis::Y ? "y"
                                                     : "x and y";
        const std::string with =
            "  " + label(bench.simulation().world(), other) + ", along " + axis;
        const std::string what = contact.collided
                                     ? formatted(": %.4g kg px/s at %.4g px/s",
                                                 contact.impulse.norm(), contact.approach.norm())
                                     : ", touching";
        ImGui::TextUnformatted((with + what).c_str());
    }
    if (rows == 0) ImGui::TextUnformatted("  none");
    if (rows > mostRows) ImGui::Text("  and %d more", rows - mostRows);
}

}  // namespace

void showEntityWindow(const PanelContext& context) {
    Workbench& bench = context.bench;
    const auto entity = bench.selected();
    if (!entity) return;
    const auto margin = float(10 * context.scale);
    ImGui::SetNextWindowPos({float(context.width) - margin, margin}, ImGuiCond_Always, {1, 0});
    ImGui::SetNextWindowSizeConstraints({float(250 * context.scale), 0},
                                        {float(context.width), float(context.height)});
    bool open = true;
    const World& world = bench.simulation().world();
    const std::string title = "Entity " + label(world, *entity) + "###entity";
    if (ImGui::Begin(title.c_str(), &open, fixedWindow | ImGuiWindowFlags_NoFocusOnAppearing)) {
        showComponents(world, *entity);
        showContacts(bench, *entity);
        bool follow = bench.following();
        if (ImGui::Checkbox("follow", &follow)) bench.toggleFollow();
    }
    ImGui::End();
    if (!open) bench.select(std::nullopt);
}

void showHelpWindow(const PanelContext& context) {
    if (!context.view.help) return;
    ImGui::SetNextWindowPos({float(context.width) / 2, float(context.height) / 2}, ImGuiCond_Always,
                            {0.5f, 0.5f});
    if (ImGui::Begin("Help", &context.view.help, fixedWindow) &&
        ImGui::BeginTable("keys", 2, ImGuiTableFlags_SizingFixedFit)) {
        const auto row = [](const char* left, const char* right) {
            ImGui::TableNextColumn();
            ImGui::TextUnformatted(left);
            ImGui::TableNextColumn();
            ImGui::TextDisabled("%s", right);
        };
        for (const KeyCommand& command : keyCommands()) {
            if (command.label != nullptr) row(command.label, command.meaning);
        }
        row("click", "select an entity");
        row("drag", "pan");
        row("wheel", "zoom to the cursor");
        row("drop a file", "open a scene");
        ImGui::EndTable();
    }
    ImGui::End();
}

void showMessage(const PanelContext& context) {
    const Workbench::Message* message = context.bench.message();
    if (message == nullptr) return;
    const ScreenRect rect = worldRect(context.view, context.scale, context.width, context.height);
    ImGui::SetNextWindowPos({float(rect.center().x()), float(rect.height - 12 * context.scale)},
                            ImGuiCond_Always, {0.5f, 1});
    ImGui::SetNextWindowBgAlpha(0.92f);
    if (ImGui::Begin("message", nullptr,
                     ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_AlwaysAutoResize |
                         ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoInputs |
                         ImGuiWindowFlags_NoFocusOnAppearing)) {
        ImGui::PushTextWrapPos(float(rect.width - 60 * context.scale));
        const ImVec4 color = message->isError
                                 ? ImGui::ColorConvertU32ToFloat4(packed(theme.errorText))
                                 : ImGui::GetStyleColorVec4(ImGuiCol_Text);
        ImGui::TextColored(color, "%s", message->text.c_str());
        ImGui::PopTextWrapPos();
    }
    ImGui::End();
}

}  // namespace quadrille::app
