/* tests/fuzz/fuzz.c -- Random command lines and random files for the program build/fvi.
 *
 *     fuzz SEED LINES FILES [CASE]       (make fuzz; make test-fuzz for a short one)
 *
 * The program's main is called in this process, under the name fvi_main, so that the
 * sanitizers see all of it. It must return 0, 1 or 2; with 2 it must have printed
 * nothing but two lines on standard error; a file under -o must be
 * complete, or as it was; nothing else may be left. With CASE only that one is run, and its
 * words are printed. */
#define _GNU_SOURCE
#include <dirent.h>
#include <fcntl.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#define LEN(array) (sizeof(array) / sizeof((array)[0]))

int fvi_main(int argc, char **argv);

/* ---- dice ---- */

static unsigned long long state;

static size_t dice(size_t n)
{
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return (size_t)(state >> 33) % n;
}

/* The state of case number n does not depend on those before it. */
static void seed(unsigned long long s, size_t n)
{
    state = s * 0x9e3779b97f4a7c15ULL + n * 0xd1342543de82ef95ULL;
    dice(1);
    dice(1);
}

static const char *one_of(const char *const *words, size_t n)
{
    return words[dice(n)];
}

#define ONE_OF(words) one_of(words, LEN(words))

/* ---- words ---- */

enum { WORD = 400, WORDS = 24 };

static char words[WORDS][WORD];
static int count;

__attribute__((format(printf, 1, 2))) static void add(const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    if (count < WORDS)
        vsnprintf(words[count++], WORD, format, arguments);
    va_end(arguments);
}

/* Some bytes changed, put in or left out. */
static void spoil(char *word)
{
    static const char *const bits[] = {
        "-", ",", ":",  "(",    ")",   "^",     "*",   "e", ".", "x", "'", "=",
        "@", "%", "\n", "\xff", "nan", "1e999", " + ", "t", "k", "/", "#", "\t"
    };
    for (size_t times = 1 + dice(3); times > 0; times--) {
        const size_t length = strlen(word), at = dice(length + 1);
        const char *bit = ONE_OF(bits);
        if (dice(3) == 0 && at < length)
            memmove(word + at, word + at + 1, length - at);
        else if (length + strlen(bit) + 1 < WORD) {
            memmove(word + at + strlen(bit), word + at, length - at + 1);
            memcpy(word + at, bit, strlen(bit));
        }
    }
}

/* An expression, mostly a right one, behind what stands in the word. */
static void expression(char *word, const char *const *names, size_t depth)
{
    static const char *const functions[] = { "sin",  "cos",  "tan",  "exp",
                                             "log",  "sqrt", "tanh", "abs",
                                             "asin", "cosh", "sine" };
    static const char *const numbers[] = { "1",    "2",  "0.5", ".25",
                                           "3e-1", "pi", "0" };
    const size_t used = strlen(word), room = WORD - used;
    char *end = word + used;
    if (depth == 0 || room < 40) {
        snprintf(end, room, "%s", dice(2) ? names[dice(4)] : ONE_OF(numbers));
        return;
    }
    const size_t kind = dice(6);
    snprintf(end, room, "%s",
             kind == 0   ? ONE_OF(functions)
             : kind == 1 ? "-"
                         : "");
    strcat(word, "(");
    expression(word, names, depth - 1);
    strcat(word, ")");
    if (kind > 2 && strlen(word) + 40 < WORD) {
        static const char *const signs[] = { "+",  "-",   "*",   "/", "^",
                                             "**", " - ", "^2*", "" };
        strcat(word, ONE_OF(signs));
        expression(word, names, depth - 1);
    }
}

static void number(char *word)
{
    static const char *const good[] = { "0.5", "0.3", "1", "0.75", "1e-3" };
    static const char *const numbers[] = {
        "0",     "-1",     "2",      "1e300", "nan",   "inf",      "",  "1,2",
        "1,2,3", "1e-310", "0x1p-1", "@list", "@data", "@nowhere", "-0"
    };
    snprintf(word, WORD, "%s", dice(3) ? ONE_OF(good) : ONE_OF(numbers));
}

/* How much work a run may be is bounded by these, which are not spoiled. */
static const char *few(void)
{
    static const char *const counts[] = { "1",   "2",   "7", "50",   "300", "0",
                                          "2.5", "1e1", "x", "1e18", "-3" };
    return ONE_OF(counts);
}

static void potential(char *word)
{
    static const char *const names[] = { "x", "x", "x1", "k" };
    static const char *const known[] = {
        "harmonic:1",  "harmonic",    "duffing:1,2", "pendulum:9", "free",
        "chain:3,1,1", "chain:1,1,0", "chain:2,1",   "HARMONIC",   "duffing:1"
    };
    *word = '\0';
    if (dice(2))
        strcpy(word, ONE_OF(known));
    else
        expression(word, names, 1 + dice(4));
}

static void force(char *word)
{
    static const char *const names[] = { "t", "t", "k", "x" };
    static const char *const known[] = {
        "none",      "step:1,2", "cosine:1,2", "file:data",
        "file:list", "file:",    "step:1",     "file:nowhere"
    };
    *word = '\0';
    for (size_t parts = 1 + dice(3); parts > 0 && strlen(word) < 200; parts--) {
        if (dice(2))
            strcat(word, ONE_OF(known));
        else
            expression(word, names, dice(3));
        if (parts > 1)
            strcat(word, " + ");
    }
}

static void method(char *word)
{
    static const char *const known[] = {
        "fvi",          "lda",          "euler-explicit", "euler-implicit",
        "fvi-shifted",  "fvi-bdf2",     "fvi-lobatto2",   "fvi-lobatto3",
        "fvi-lobatto4", "fvi-adaptive", "fvi-stable",     "rk4"
    };
    strcpy(word, ONE_OF(known));
}

static void columns(char *word)
{
    static const char *const known[] = { "t",      "x",    "p",
                                         "energy", "y",    "t,x,p,energy",
                                         "x,y",    "t,,x", "q" };
    strcpy(word, ONE_OF(known));
}

static void let(char *word)
{
    static const char *const known[] = {
        "k=1", "k=2,c=k*k", "c=1/0", "x=1", "k", "k=", "=1", "k=1,k=1"
    };
    strcpy(word, ONE_OF(known));
}

static void small(const char *option, char *word)
{
    static const struct {
        const char *option, *words[5];
    } known[] = { { "memory", { "auto", "direct", "fft", "exponentials" } },
                  { "derivative", { "held", "caputo", "rl" } },
                  { "format", { "tsv", "csv", "json", "JSON" } },
                  { "checkpoint", { "saved" } },
                  { "part", { "1/2", "2/2", "3/2" } },
                  { "vary", { "x0=1:2:3", "alpha=0:1:2", "k=1:4:3:log" } },
                  { "of", { "x", "p", "energy", "x:1" } },
                  { "jobs", { "1", "3" } },
                  { "damping",
                    { "zener:1,0.3,0.1", "maxwell:1,2", "power:1,0.3",
                      "distributed:1,0,1" } },
                  { "error", { "0.1", "1e-3" } } };
    strcpy(word, "1");
    for (size_t i = 0; i < LEN(known); i++)
        if (strcmp(known[i].option, option) == 0) {
            size_t n = 0;
            while (known[i].words[n])
                n++;
            strcpy(word, known[i].words[dice(n)]);
        }
}

static void option(void)
{
    static const char *const numeric[] = { "alpha", "rho",       "mass",
                                           "kappa", "x0",        "p0",
                                           "h",     "tolerance", "time" };
    static const char *const counted[] = { "every", "dimension" };
    static const char *const others[] = { "memory", "derivative", "format" };
    static const char *const rare[] = { "checkpoint", "part",    "vary",
                                        "of",         "damping", "jobs",
                                        "error",      "fit",     "count" };
    static const struct {
        const char *name;
        void (*value)(char *);
    } made[] = { { "potential", potential },
                 { "force", force },
                 { "method", method },
                 { "columns", columns },
                 { "let", let },
                 { "potential", potential } };
    char value[WORD] = "";
    const char *name;
    const size_t kind = dice(10), one = dice(LEN(made));
    if (kind < 4) {
        name = ONE_OF(numeric);
        number(value);
    } else if (kind < 5) {
        add("--%s", ONE_OF(counted));
        add("%s", few());
        return;
    } else if (kind < 8) {
        name = made[one].name;
        made[one].value(value);
    } else {
        name = dice(5) ? ONE_OF(others) : ONE_OF(rare);
        small(name, value);
    }
    if (dice(12) == 0)
        spoil(value);
    if (dice(4)) {
        add("--%s", name);
        if (dice(40))
            add("%s", value);
    } else {
        add("--%.20s=%.370s", name, value);
    }
}

/* ---- one case ---- */

static void random_line(void)
{
    static const char *const commands[] = { "run",   "run",   "run",
                                            "exact", "sweep", "gradient" };
    static const char *const rare[] = { "coefficients", "methods", "help",
                                        "--version",    "rum",     "" };
    const char *command = dice(12) ? ONE_OF(commands) : ONE_OF(rare);
    add("fvi");
    add("%s", command);
    if (strcmp(command, "sweep") == 0 && dice(9)) {
        add("--vary");
        add("%s", dice(2) ? "x0=1:2:3" : "k=1:4:3:log");
    } else if (dice(2)) {
        add("--let=k=2");
    }
    for (size_t n = dice(5); n > 0; n--)
        option();
    if (dice(40))
        add("--steps=%s", dice(9) ? "20" : few());
    if (dice(20) == 0)
        add("%s", dice(2) ? "-h" : "--continue");
    if (dice(4) == 0) {
        add("-o");
        add("out");
    }
    if (dice(30) == 0)
        spoil(words[dice((size_t)count)]);
}

/* Bytes of a table, spoiled a little or much. */
static void random_file(const char *name)
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
    fprintf(f, dice(2) ? "1e9 1\n" : "");
    fclose(f);
}

/* The checkpoint with some bytes changed, or cut. */
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

/* A matrix of three unknowns, mostly a right one with some bytes changed. */
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
        random_file("f.tsv");
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
    random_file("data");
    add(kind == 3 ? "fit" : "run");
    if (kind == 1)
        add("--force=%s", ONE_OF(forces));
    else if (kind == 2)
        add("--%s=@data", ONE_OF(lists));
    else
        add("--starts=2");
    if (kind == 3)
        add("data");
    if (kind == 2)
        add("--dimension=%zu", 1 + dice(4));
    if (kind != 3)
        add("--steps=%s", dice(2) ? "20" : "7");
    add("-o");
    add("out");
}

/* ---- the verdict ---- */

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

/* A whole table of any format ends so; help ends with a full stop or an example. */
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

static size_t seen[3]; /* of each exit code */

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

/* Cases from number `from` on. Returns how many failed. */
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
        FILE *last = fopen("case", "w"); /* for when it crashes */
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

int main(int argc, char **argv)
{
    if (argc < 4)
        return 2;
    const unsigned long long s = strtoull(argv[1], NULL, 10);
    const size_t lines = strtoul(argv[2], NULL, 10),
                 files = strtoul(argv[3], NULL, 10),
                 only = argc > 4 ? strtoul(argv[4], NULL, 10) : 0;
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
    if (chdir("/") != 0)
        return 1;
    snprintf(line, sizeof line, "rm -rf %s", home);
    printf("%zu random command lines, %zu random files: %zu done, %zu not "
           "possible, %zu refused; %zu failures\n",
           lines, files, seen[0], seen[1], seen[2], failed);
    const int left = system(line);
    if (!only && (seen[0] < (lines + files) / 10 || !seen[1] || !seen[2]))
        return 1; /* too little was tried */
    return failed > 0 || left != 0;
}
