#include "third_party/imgui.h"

#include <algorithm>
#include <vector>

#include <imgui.h>

#include <backends/imgui_impl_glfw.h>

namespace {

std::vector<imgui_vertex> frame_vertices;
std::vector<imgui_batch> frame_batches;

// Names are on the left, and widgets to the right of them in one column.
constexpr float NAME_PART = 0.36f;

void show_name(const char *name) {
    ImGui::AlignTextToFramePadding();
    ImGui::TextUnformatted(name);
    ImGui::SameLine(NAME_PART * ImGui::GetWindowWidth());
    ImGui::SetNextItemWidth(-1);
}

/// Identifies a widget by its name, which is shown already.
struct hidden_name {
    explicit hidden_name(const char *name) {
        ImGui::PushID(name);
    }
    ~hidden_name() {
        ImGui::PopID();
    }
};

void append_batch(const ImDrawList *list, const ImDrawCmd &command, const ImVec2 &offset) {
    imgui_batch batch = {};
    batch.first = static_cast<uint32_t>(frame_vertices.size());
    batch.count = command.ElemCount;
    const ImVec4 &clip = command.ClipRect;
    batch.clip[0] = clip.x - offset.x;
    batch.clip[1] = clip.y - offset.y;
    batch.clip[2] = clip.z - offset.x;
    batch.clip[3] = clip.w - offset.y;
    for (unsigned i = 0; i < command.ElemCount; i++) {
        const ImDrawIdx index = list->IdxBuffer[static_cast<int>(command.IdxOffset + i)];
        const ImDrawVert &from = list->VtxBuffer[static_cast<int>(command.VtxOffset) + index];
        frame_vertices.push_back(
            {{from.pos.x - offset.x, from.pos.y - offset.y}, {from.uv.x, from.uv.y}, from.col});
    }
    frame_batches.push_back(batch);
}

/// The built-in font, at a whole number of pixels.
void set_font(float scale) {
    ImFontConfig font;
    font.SizePixels = static_cast<float>(static_cast<int>(13 * scale + 0.5f));
    ImGui::GetIO().Fonts->AddFontDefault(&font);
}

/// Converts the window's sizes and positions, whose units may be larger than pixels, to pixels.
void go_by_pixels() {
    ImGuiIO &io = ImGui::GetIO();
    const ImVec2 pixels = io.DisplayFramebufferScale;
    io.DisplaySize = ImVec2(io.DisplaySize.x * pixels.x, io.DisplaySize.y * pixels.y);
    io.DisplayFramebufferScale = ImVec2(1, 1);
    if (ImGui::IsMousePosValid(&io.MousePos))
        io.MousePos = ImVec2(io.MousePos.x * pixels.x, io.MousePos.y * pixels.y);
}

void set_style(float scale) {
    ImGuiStyle &style = ImGui::GetStyle();
    style = ImGuiStyle(); // scaled sizes cannot be scaled back
    ImGui::StyleColorsDark();
    style.WindowRounding = style.FrameRounding = style.GrabRounding = 3;
    style.WindowBorderSize = 0;
    style.ItemSpacing = ImVec2(6, 3);
    style.FramePadding = ImVec2(4, 2);
    style.WindowPadding = ImVec2(8, 8);
    style.Colors[ImGuiCol_WindowBg] = ImVec4(0.07f, 0.08f, 0.09f, 0.94f);
    style.ScaleAllSizes(scale);
}

} // namespace

bool imgui_open(GLFWwindow *window, float scale) try {
    ImGui::CreateContext();
    ImGuiIO &io = ImGui::GetIO();
    io.IniFilename = nullptr; // do not save the layout between runs
    io.BackendFlags |= ImGuiBackendFlags_RendererHasVtxOffset;
    set_font(scale);
    set_style(scale);
    return ImGui_ImplGlfw_InitForOther(window, true);
} catch (...) {
    return false;
}

bool imgui_rescale(float scale) try {
    ImGui::GetIO().Fonts->Clear();
    set_font(scale);
    set_style(scale);
    return true;
} catch (...) {
    return false;
}

void imgui_close(void) {
    if (!ImGui::GetCurrentContext())
        return;
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
    frame_vertices = {};
    frame_batches = {};
}

const uint8_t *imgui_font(uint32_t *width, uint32_t *height) {
    unsigned char *texels = nullptr;
    int columns = 0, rows = 0;
    ImGui::GetIO().Fonts->GetTexDataAsAlpha8(&texels, &columns, &rows);
    *width = static_cast<uint32_t>(columns);
    *height = static_cast<uint32_t>(rows);
    return texels;
}

void imgui_begin_frame(void) {
    ImGui_ImplGlfw_NewFrame();
    go_by_pixels();
    ImGui::NewFrame();
}

void imgui_end_frame(void) {
    ImGui::Render();
    const ImDrawData *data = ImGui::GetDrawData();
    frame_vertices.clear();
    frame_batches.clear();
    for (int i = 0; i < data->CmdListsCount; i++)
        for (const ImDrawCmd &command : data->CmdLists[i]->CmdBuffer)
            if (!command.UserCallback && command.ElemCount > 0)
                append_batch(data->CmdLists[i], command, data->DisplayPos);
}

size_t imgui_triangles(const imgui_vertex **vertices, size_t *vertex_count,
                       const imgui_batch **batches) {
    *vertices = frame_vertices.data();
    *vertex_count = frame_vertices.size();
    *batches = frame_batches.data();
    return frame_batches.size();
}

bool imgui_takes_mouse(void) {
    return ImGui::GetIO().WantCaptureMouse;
}

void imgui_show_drag_pointer(void) {
    ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
}

bool imgui_takes_keys(void) {
    return ImGui::GetIO().WantTextInput;
}

// ---------------------------------------------------------------------------------------------
// Widgets

constexpr ImGuiWindowFlags FIXED = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav |
                                   ImGuiWindowFlags_NoFocusOnAppearing;

void imgui_begin_note(const char *name, const float place[2], float width) {
    ImGui::SetNextWindowPos(ImVec2(place[0], place[1]), ImGuiCond_Always, ImVec2(0, 1));
    ImGui::SetNextWindowSizeConstraints(ImVec2(width, 0), ImVec2(width, 1e6f));
    ImGui::Begin(name, nullptr, FIXED | ImGuiWindowFlags_AlwaysAutoResize);
}

void imgui_begin_list(const char *name, const float place[2], float width, float maximum_height) {
    ImGui::SetNextWindowPos(ImVec2(place[0], place[1]), ImGuiCond_Always, ImVec2(1, 0));
    ImGui::SetNextWindowSizeConstraints(ImVec2(width, 0), ImVec2(width, maximum_height));
    ImGui::Begin(name, nullptr,
                 (FIXED & ~ImGuiWindowFlags_NoScrollbar) | ImGuiWindowFlags_AlwaysAutoResize);
}

void imgui_begin_panel(const char *name, const float place[2], const float size[2]) {
    ImGuiWindowFlags flags = FIXED & ~ImGuiWindowFlags_NoScrollbar;
    ImGui::SetNextWindowPos(ImVec2(place[0], place[1]));
    if (size[0] > 0) {
        ImGui::SetNextWindowSize(ImVec2(size[0], size[1]));
    } else {
        ImGui::SetNextWindowSizeConstraints(ImVec2(0, 0), ImVec2(1e6f, size[1]));
        flags |= ImGuiWindowFlags_AlwaysAutoResize;
    }
    ImGui::Begin(name, nullptr, flags);
}

void imgui_end_panel(void) {
    ImGui::End();
}

void imgui_begin_group(const char *name) {
    ImGui::PushID(name);
}

void imgui_end_group(void) {
    ImGui::PopID();
}

bool imgui_section(const char *title, bool open) {
    return ImGui::CollapsingHeader(title, open ? ImGuiTreeNodeFlags_DefaultOpen : 0);
}

void imgui_text(const char *text) {
    ImGui::PushTextWrapPos(0);
    ImGui::TextUnformatted(text);
    ImGui::PopTextWrapPos();
}

void imgui_faint_text(const char *text) {
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    imgui_text(text);
    ImGui::PopStyleColor();
}

void imgui_line(const char *left, const char *right) {
    const float edge = ImGui::GetWindowContentRegionMax().x;
    ImGui::TextUnformatted(left);
    ImGui::SameLine(edge - ImGui::CalcTextSize(right).x);
    ImGui::TextUnformatted(right);
}

void imgui_indented_line(const char *left, const char *right) {
    ImGui::Indent(ImGui::GetFontSize());
    imgui_line(left, right);
    ImGui::Unindent(ImGui::GetFontSize());
}

void imgui_term(const char *name, const char *meaning) {
    const float column = 8.5f * ImGui::GetFontSize();
    ImGui::TextUnformatted(name);
    ImGui::SameLine(column);
    ImGui::PushTextWrapPos(column + 26 * ImGui::GetFontSize());
    ImGui::TextUnformatted(meaning);
    ImGui::PopTextWrapPos();
}

void imgui_space(void) {
    ImGui::Dummy(ImVec2(0, 0.3f * ImGui::GetFontSize()));
}

void imgui_tooltip(const char *text) {
    if (!ImGui::IsItemHovered())
        return;
    ImGui::BeginTooltip();
    ImGui::PushTextWrapPos(28 * ImGui::GetFontSize());
    ImGui::TextUnformatted(text);
    ImGui::PopTextWrapPos();
    ImGui::EndTooltip();
}

bool imgui_button(const char *name) {
    return ImGui::Button(name);
}

bool imgui_checkbox(const char *name, bool *value) {
    show_name(name);
    hidden_name id(name);
    return ImGui::Checkbox("##value", value);
}

bool imgui_choice(const char *name, const char *const *choices, size_t count, size_t *index) {
    show_name(name);
    hidden_name id(name);
    bool changed = false;
    if (!ImGui::BeginCombo("##value", *index < count ? choices[*index] : ""))
        return false;
    for (size_t i = 0; i < count; i++) {
        if (ImGui::Selectable(choices[i], i == *index) && i != *index) {
            *index = i;
            changed = true;
        }
    }
    ImGui::EndCombo();
    return changed;
}

bool imgui_number(const char *name, double minimum, double maximum, double *value) {
    show_name(name);
    hidden_name id(name);
    if (!ImGui::SliderScalar("##value", ImGuiDataType_Double, value, &minimum, &maximum, "%.3g",
                             ImGuiSliderFlags_AlwaysClamp))
        return false;
    *value = std::clamp(*value, minimum, maximum);
    return true;
}

bool imgui_integer(const char *name, int minimum, int maximum, int *value) {
    show_name(name);
    hidden_name id(name);
    return ImGui::SliderInt("##value", value, minimum, maximum, "%d", ImGuiSliderFlags_AlwaysClamp);
}

bool imgui_colour(const char *name, float colour[3]) {
    show_name(name);
    hidden_name id(name);
    float edited[3] = {colour[0], colour[1], colour[2]};
    bool changed = false;
    ImGui::ColorEdit3("##value", edited);
    for (int i = 0; i < 3; i++) {
        // Typed numbers may be any.
        const float value = std::clamp(edited[i], 0.0f, 1.0f);
        changed |= value != colour[i];
        colour[i] = value;
    }
    return changed;
}

void imgui_same_line(void) {
    ImGui::SameLine();
}
