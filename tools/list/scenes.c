#include <stdio.h>

#include "tools/cli/options.h"
#include "tools/cli/subcommand.h"
#include "tools/manual/roff.h"
#include "tools/scenes/scene_list.h"

static void print_manual(FILE *stream) {
    roff_section(stream, "SCENES");
    for (size_t i = 0; i < scene_list_count(); i++) {
        const listed_scene scene = scene_list_get(i);
        roff_item(stream, scene.name, NULL, scene.summary);
    }
}

static int run(int argc, char **argv) {
    const option_table table = {
        .program = "lobe scenes",
        .summary =
            "Lists the scenes known by name. Wherever a scene is expected, it may also be the "
            "path\n"
            "of a .gltf or .glb file, or a folder of PBR maps, which are put on a cloth. Assets\n"
            "are read from the folder given by --assets DIR or LOBE_ASSETS.",
        .manual = print_manual,
    };
    int status;
    if (!options_parse(&table, argc, argv, NULL, &status))
        return status;
    for (size_t i = 0; i < scene_list_count(); i++) {
        const listed_scene scene = scene_list_get(i);
        printf("%-14s %s\n", scene.name, scene.summary);
    }
    return 0;
}

const subcommand scenes_subcommand = {"scenes", "list the scenes known by name", run};
