#include "run_peer.h"

#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

double run_peer_now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void become(const char *directory, const char *scripts, const char *name, const char *path, const char *result)
{
    char program[600], script[600];
    int out = open(result, O_WRONLY | O_CREAT | O_TRUNC, 0644), silent = open("/dev/null", O_WRONLY);
    dup2(out, STDOUT_FILENO);
    dup2(silent, STDERR_FILENO);
    snprintf(program, sizeof program, "%s/peer_%s", directory, name);
    snprintf(script, sizeof script, "%s/peer_%s.py", scripts, name);
    if (access(script, R_OK) == 0)
        execlp("/usr/bin/python3", "/usr/bin/python3", script, path, (char *)NULL);
    else
        execl(program, program, path, (char *)NULL);
    _exit(127);
}

int run_peer(const char *directory, const char *scripts, const char *name, const char *path, const char *result, double limit)
{
    pid_t child = fork();
    if (child == 0) become(directory, scripts, name, path, result);
    double start = run_peer_now();
    int status;
    while (waitpid(child, &status, WNOHANG) == 0) {
        if (run_peer_now() - start > limit) {
            kill(child, SIGKILL);
            waitpid(child, &status, 0);
            return 0;
        }
        nanosleep(&(struct timespec){0, 2000000}, NULL);
    }
    return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}
