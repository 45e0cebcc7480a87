/* tests/random/fuzz/fuzz.c -- Run the program build/fvi with random command lines and files.
 *
 *       fuzz SEED LINES FILES STATES FITS [CASE]   (make fuzz; make test-fuzz for a short run)
 *
 * The main function of the program is called in this process, under the name fvi_main, so that the sanitizers see
 * all of it. It must return 0, 1 or 2. If it returns 2, it must have printed two lines on standard error and
 * nothing else. A file under -o must be complete or unchanged, and no other file may be left. With CASE, only
 * this case is run, and its words are printed. random_words.c makes the words. After the command lines and files,
 * the library gets STATES damaged states of runs (random_states.c), without files.
 *
 * One fit in FITS may have data up to t = 1e9, the others up to 3e3. A fit to t = 1e9 may take millions of steps and
 * several seconds. So `make test-fuzz` has few of them (FITS = 50). In `make fuzz` every fit may be one (FITS = 1). */
#define _GNU_SOURCE
#include <dirent.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "random_states.h"
#include "random_words.h"

int fvi_main(int argc, char **argv);

/* ---- random files ---- */

/* Write a file with lines of a table, some of them damaged. The last row may be at the time `far`. */
static void random_file(const char *name, const char *far)
{
    FILE *f = fopen(name, "w");
    if (!f)
        exit(1);
    static const char *const lines[] = { "# t\tF\n", "t,F\n", "\"F\",\"t\"\n",
                                         "#\n",      "\n",    "0 1 2\n",
                                         "1,2\r\n",  "x y\n", "1 nan\n",
                                         "1\n",      "1 2 3", "1;2\n",
                                         "-1 0\n" };
    double t = 0;
    for (size_t n = dice(30); n > 0; n--) {
        if (dice(5)) {
            t += dice(20) ? (double)dice(100) / 10 : -1;
            fprintf(f, "%g\t%g\n", t, (double)dice(1000) / 7 - 50);
        } else if (dice(20)) {
            fputs(ONE_OF(lines), f);
        } else {
            for (size_t bytes = dice(300); bytes > 0; bytes--)
                fputc((int)dice(256), f);
        }
    }
    if (dice(2))
        fprintf(f, "%s 1\n", far);
    fclose(f);
}

/* Make the last eight bytes the checksum (FNV-1a) of all bytes before them, as an attacker would. */
static void make_sum(unsigned char *bytes, size_t size)
{
    unsigned long long sum = 0xcbf29ce484222325u;
    for (size_t i = 0; i + sizeof sum < size; i++)
        sum = (sum ^ bytes[i]) * 0x100000001b3u;
    if (size >= sizeof sum)
        memcpy(bytes + size - sizeof sum, &sum, sizeof sum);
}

/* Change or cut some bytes of the checkpoint. Its checksum is mostly made right again. */
static void spoil_checkpoint(void)
{
    static unsigned char bytes[1 << 16];
    FILE *f = fopen("good", "r");
    size_t size = f ? fread(bytes, 1, sizeof bytes, f) : 0;
    if (f)
        fclose(f);
    for (size_t n = dice(3); size > 0 && n > 0; n--)
        bytes[dice(size)] ^= (unsigned char)(1u << dice(8));
    if (size > 0 && dice(3) == 0)
        size = dice(size);
    if (dice(3))
        make_sum(bytes, size);
    if ((f = fopen("saved", "w"))) {
        fwrite(bytes, 1, size, f);
        fclose(f);
    }
}

static void put_file(const char *name, const char *text)
{
    FILE *f = fopen(name, "w");
    if (!f || fputs(text, f) < 0 || fclose(f) != 0)
        exit(1);
}

/* Write a matrix of three unknowns, which is mostly right but for some bytes. */
static void random_matrix(const char *name, const char *entries)
{
    static const char *const heads[] = {
        "%%MatrixMarket matrix coordinate real symmetric\n",
        "%%MatrixMarket matrix coordinate real symmetric\n",
        "%%MatrixMarket matrix coordinate integer general\n",
        "%%MatrixMarket matrix array real symmetric\n"
    };
    char word[WORD];
    snprintf(word, WORD, "%s3 3 %s", dice(8) ? heads[0] : ONE_OF(heads),
             entries);
    if (dice(3) == 0)
        spoil(word);
    put_file(name, word);
}

static void random_system(void)
{
    static const char *const dampings[] = { "1\n1 1 0.5\n",
                                            "3\n1 1 1\n2 1 -1\n2 2 1\n",
                                            "1\n2 1 1\n", "0\n" };
    random_matrix("M.mtx", "3\n1 1 1\n2 2 2\n3 3 1\n");
    random_matrix("K.mtx", "5\n1 1 2\n2 1 -1\n2 2 2\n3 2 -1\n3 3 2\n");
    random_matrix("C.mtx", ONE_OF(dampings));
    if (dice(2))
        random_file("f.tsv", "1e9");
    else
        remove("f.tsv");
    add("run");
    add("--system=.");
    add("--steps=%s", few());
    if (dice(2))
        add("--unknowns=%s", dice(2) ? "3,1" : few());
    if (dice(2))
        add("--snapshot=end");
}

static size_t fits_per_long_fit; /* FITS */

static void random_file_and_line(void)
{
    static const char *const forces[] = { "file:data", "FILE:data + t" };
    static const char *const lists[] = { "x0", "p0", "mass", "rho" };
    const size_t kind = dice(5);
    add("fvi");
    if (kind == 4) {
        random_system();
        return;
    }
    if (kind == 0) {
        spoil_checkpoint();
        add("run");
        add("--alpha=0.3");
        add("--steps=300");
        add("--checkpoint=saved");
        add("--continue");
        return;
    }
    random_file("data", kind == 3 && dice(fits_per_long_fit) > 0 ? "3e3" : "1e9");
    add(kind == 3 ? "fit" : "run");
    if (kind == 1)
        add("--force=%s", ONE_OF(forces));
    else if (kind == 2)
        add("--%s=@data", ONE_OF(lists));
    else
        add("--starts=2");
    if (kind == 3 && dice(4) == 0) {
        add("--method=fvi-adaptive");
        add("--most-steps=%s", few());
    }
    if (kind == 3)
        add("data");
    if (kind == 2)
        add("--dimension=%zu", 1 + dice(4));
    if (kind != 3)
        add("--steps=%s", dice(2) ? "20" : "7");
    add("-o");
    add("out");
}

/* ---- checks ---- */

static const char kept[] = "what was there\n";

static char text[1 << 22];

static const char *get_file(const char *name)
{
    FILE *f = fopen(name, "r");
    size_t n = f ? fread(text, 1, sizeof text - 1, f) : 0;
    text[n] = '\0';
    if (f)
        fclose(f);
    return text;
}

/* Return whether a table is complete. Each format ends in this way; help ends with a full stop or an example. */
static int is_whole(const char *table)
{
    const size_t length = strlen(table);
    return length > 0 && table[length - 1] == '\n'
           && (*table != '{'
               || (length > 3 && strcmp(table + length - 3, "]}\n") == 0));
}

static size_t lines_of(const char *at)
{
    size_t n = 0;
    for (; *at; at++)
        n += *at == '\n';
    return n;
}

static size_t seen[3]; /* the number of cases with each exit code */

static const char *judge(int status)
{
    if (status >= 0 && status < 3)
        seen[status]++;
    DIR *folder = opendir(".");
    for (struct dirent *e; folder && (e = readdir(folder));)
        if (strncmp(e->d_name, ".fvi-", 5) == 0 || strstr(e->d_name, ".new")) {
            closedir(folder);
            return "a file is left over";
        }
    if (folder)
        closedir(folder);
    const char *file = get_file("out");
    if (strcmp(file, kept) != 0 && (status != 0 || !is_whole(file)))
        return "-o: neither whole nor as it was";
    if (status < 0 || status > 2)
        return "exit code";
    if (status != 2)
        return NULL;
    if (*get_file("stdout"))
        return "refused, and something printed";
    const size_t lines = lines_of(get_file("stderr"));
    return lines == 2 ? NULL : "refused in other than two lines";
}

static const char *run(int (*program)(int, char **))
{
    char *argv[WORDS + 1] = { NULL };
    int saved[2];
    for (int i = 0; i < count; i++)
        argv[i] = words[i];
    put_file("out", kept);
    fflush(NULL);
    for (int fd = 1; fd <= 2; fd++) {
        const int to = open(fd == 1 ? "stdout" : "stderr",
                            O_WRONLY | O_CREAT | O_TRUNC, 0600);
        saved[fd - 1] = dup(fd);
        dup2(to, fd);
        close(to);
    }
    alarm(60);
    const int status = program(count, argv);
    alarm(0);
    fflush(NULL);
    clearerr(stdout);
    for (int fd = 1; fd <= 2; fd++) {
        dup2(saved[fd - 1], fd);
        close(saved[fd - 1]);
    }
    return judge(status);
}

static void print_words(FILE *out)
{
    for (int i = 0; i < count; i++)
        fprintf(out, " '%s'", words[i]);
    fputc('\n', out);
}

/* Run the cases from number `from` on. Return the number of failures. */
static size_t cases(unsigned long long s, size_t from, size_t to, size_t only,
                    void (*make)(void))
{
    size_t failed = 0;
    for (size_t n = from; n < to; n++) {
        if (only != 0 && n != only)
            continue;
        count = 0;
        seed(s, n);
        make();
        FILE *last = fopen("case", "w"); /* for the case that the program crashes */
        if (last) {
            fprintf(last, "%zu:", n);
            print_words(last);
            fclose(last);
        }
        const char *said = run(fvi_main);
        if (getenv("SHOW"))
            fprintf(stdout, "%s", get_file("stderr"));
        if (only)
            print_words(stdout);
        if (said) {
            printf("case %zu: %s:", n, said);
            print_words(stdout);
            failed++;
        }
    }
    return failed;
}

/* Run the cases of states. Return the number of failures, or of all cases if hardly any state, or nearly every
 * state, was refused. */
static size_t cases_of_states(unsigned long long s, size_t from, size_t to,
                              size_t only)
{
    size_t failed = 0, refused = 0;
    for (size_t n = from; n < to; n++) {
        if (only != 0 && n != only)
            continue;
        seed(s, n);
        alarm(60);
        const char *wrong = random_state(&refused);
        alarm(0);
        if (wrong || only)
            printf("case %zu: %s: %s\n", n, wrong ? wrong : "well",
                   random_state_words());
        failed += wrong != NULL;
    }
    const size_t done = to - from;
    printf("%zu random states: %zu refused; %zu failures\n", done, refused,
           failed);
    return only || (refused >= done / 5 && refused <= done - done / 5) ? failed
                                                                       : done;
}

int main(int argc, char **argv)
{
    if (argc < 6 || !(fits_per_long_fit = strtoul(argv[5], NULL, 10)))
        return 2;
    const unsigned long long s = strtoull(argv[1], NULL, 10);
    const size_t lines = strtoul(argv[2], NULL, 10),
                 files = strtoul(argv[3], NULL, 10),
                 states = strtoul(argv[4], NULL, 10),
                 only = argc > 6 ? strtoul(argv[6], NULL, 10) : 0;
    char folder[] = "/tmp/fuzz-XXXXXX", line[100];
    const char *home = mkdtemp(folder);
    if (!home || chdir(home) != 0)
        return 1;
    put_file("list", "1, 2\n3\n");
    put_file("data", "# t\tF\n0\t1\n50\t2\n");
    static char words_of_save[][30] = { "fvi", "run", "--alpha=0.3",
                                        "--steps=300", "--checkpoint=good" };
    for (size_t i = 0; i < LEN(words_of_save); i++)
        add("%s", words_of_save[i]);
    size_t failed = run(fvi_main) != NULL;
    failed += cases(s, 1, 1 + lines, only, random_line);
    failed +=
        cases(s, 1 + lines, 1 + lines + files, only, random_file_and_line);
    failed +=
        cases_of_states(s, 1 + lines + files, 1 + lines + files + states, only);
    if (chdir("/") != 0)
        return 1;
    snprintf(line, sizeof line, "rm -rf %s", home);
    printf("%zu random command lines, %zu random files: %zu done, %zu not "
           "possible, %zu refused; %zu failures\n",
           lines, files, seen[0], seen[1], seen[2], failed);
    const int left = system(line);
    if (!only && (seen[0] < (lines + files) / 10 || !seen[1] || !seen[2]))
        return 1; /* too few cases were possible */
    return failed > 0 || left != 0;
}
