#include "tools/report/script.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <spawn.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

// ---------------------------------------------------------------------------------------------
// Finding

/// The script's path from the folder of the program: in a build tree, and installed.
static const char *const places[] = {"report/lobe-report", REPORT_SCRIPT_INSTALLED};

/// Writes this program's folder, with a final slash; false if it is unknown.
static bool find_program_folder(char folder[PATH_MAX]) {
    ssize_t length = readlink("/proc/self/exe", folder, PATH_MAX - 1);
    if (length < 0)
        return false;
    folder[length] = '\0';
    char *slash = strrchr(folder, '/');
    if (slash)
        slash[1] = '\0';
    return slash != NULL;
}

static lobe_result find_script(const lobe_host *host, char path[2 * PATH_MAX]) {
    char folder[PATH_MAX];
    if (!find_program_folder(folder))
        return lobe_host_fail(host, LOBE_ERROR_NOT_FOUND, "/proc/self/exe: %s", strerror(errno));
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        const char *start = places[i][0] == '/' ? "" : folder;
        snprintf(path, 2 * PATH_MAX, "%s%s", start, places[i]);
        if (access(path, R_OK) == 0)
            return LOBE_OK;
    }
    return lobe_host_fail(host, LOBE_ERROR_NOT_FOUND,
                          "the script that draws reports is missing: neither %s%s nor %s exists",
                          folder, places[0], path);
}

// ---------------------------------------------------------------------------------------------
// Starting

/// Two pipes: [0] to the script, [1] from it; in each, the read end comes first.
typedef struct script_pipes {
    int ends[2][2];
} script_pipes;

static void close_pipes(const script_pipes *pipes) {
    for (int i = 0; i < 4; i++) {
        if (pipes->ends[i / 2][i % 2] >= 0)
            close(pipes->ends[i / 2][i % 2]);
    }
}

static bool open_pipes(script_pipes *pipes) {
    *pipes = (script_pipes){{{-1, -1}, {-1, -1}}};
    return pipe2(pipes->ends[0], O_CLOEXEC) == 0 && pipe2(pipes->ends[1], O_CLOEXEC) == 0;
}

/// Returns an errno.
static int spawn(const char *path, const char *const arguments[], const script_pipes *pipes,
                 pid_t *process) {
    // Do not cache compiled modules: run as root, the program would leave them in the installation.
    const char *command[REPORT_SCRIPT_ARGUMENTS + 4] = {"python3", "-B", path};
    for (size_t i = 0; arguments[i] && i < REPORT_SCRIPT_ARGUMENTS; i++)
        command[3 + i] = arguments[i];
    posix_spawn_file_actions_t actions;
    int error = posix_spawn_file_actions_init(&actions);
    if (error)
        return error;
    error = posix_spawn_file_actions_adddup2(&actions, pipes->ends[0][0], STDIN_FILENO);
    if (!error)
        error = posix_spawn_file_actions_adddup2(&actions, pipes->ends[1][1], STDOUT_FILENO);
    if (!error)
        error = posix_spawnp(process, command[0], &actions, NULL, (char *const *)command, environ);
    posix_spawn_file_actions_destroy(&actions);
    return error;
}

/// This process's ends, as streams.
static bool open_streams(script_pipes *pipes, report_script *script) {
    script->input = fdopen(pipes->ends[0][1], "wb");
    script->output = fdopen(pipes->ends[1][0], "rb");
    if (script->input)
        pipes->ends[0][1] = -1;
    if (script->output)
        pipes->ends[1][0] = -1;
    return script->input && script->output;
}

static void close_streams(report_script *script) {
    if (script->input)
        fclose(script->input);
    if (script->output)
        fclose(script->output);
}

static lobe_result start_failed(const lobe_host *host, int error) {
    if (error == ENOENT)
        return lobe_host_fail(host, LOBE_ERROR_NOT_FOUND,
                              "reports are drawn by Python, which is not there: install python3, "
                              "python3-matplotlib and python3-jinja2");
    return lobe_host_fail(host, LOBE_ERROR_NOT_FOUND, "python3 cannot be started: %s",
                          strerror(error));
}

lobe_result report_script_start(const char *const arguments[], const lobe_host *host,
                                report_script *script) {
    char path[2 * PATH_MAX];
    script_pipes pipes;
    *script = (report_script){0};
    lobe_result result = find_script(host, path);
    if (result != LOBE_OK)
        return result;
    int error = open_pipes(&pipes) && open_streams(&pipes, script) ? 0 : errno;
    if (!error)
        error = spawn(path, arguments, &pipes, &script->process);
    close_pipes(&pipes);
    if (error) {
        close_streams(script);
        return start_failed(host, error);
    }
    // A script that exits early reports why; the broken pipe adds nothing to that.
    script->old_handler = signal(SIGPIPE, SIG_IGN);
    return LOBE_OK;
}

// ---------------------------------------------------------------------------------------------
// Finishing

static bool read_output(FILE *output, char **text, size_t *size) {
    char part[1 << 14];
    size_t count;
    FILE *whole = open_memstream(text, size);
    while (whole && (count = fread(part, 1, sizeof part, output)) > 0)
        fwrite(part, 1, count, whole);
    bool failed = !whole || ferror(whole) || ferror(output);
    return whole && fclose(whole) == 0 && !failed;
}

static int wait_for(pid_t process) {
    int status = 0;
    while (waitpid(process, &status, 0) < 0 && errno == EINTR)
        continue;
    return status;
}

lobe_result report_script_finish(report_script *script, const lobe_host *host, char **text,
                                 size_t *size) {
    *text = NULL;
    fclose(script->input);
    bool complete = read_output(script->output, text, size);
    fclose(script->output);
    int status = wait_for(script->process);
    signal(SIGPIPE, script->old_handler);
    lobe_result result = LOBE_OK;
    if (WIFSIGNALED(status))
        result =
            lobe_host_fail(host, LOBE_ERROR_READ, "the script that draws reports was ended: %s",
                           strsignal(WTERMSIG(status)));
    else if (WEXITSTATUS(status) != 0)
        result = LOBE_ERROR_READ;
    else if (!complete)
        result = lobe_host_fail(host, LOBE_ERROR_OUT_OF_MEMORY, "no memory for the page");
    if (result != LOBE_OK) {
        free(*text);
        *text = NULL;
    }
    return result;
}
