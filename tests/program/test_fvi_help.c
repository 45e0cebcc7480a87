/* tests/program/test_fvi_help.c -- The program build/fvi: its help.
 * Run alone: make test-fvi_help */
#define _GNU_SOURCE
#include <fvi/formulas.h>
#include <fvi/fvi.h>
#include <fvi/rheology.h>
#include "program.h"

/* Does the word stand in the text, by itself? */
static int stands_in(const char *word, const char *text)
{
    static const char letters[] = "abcdefghijklmnopqrstuvwxyz0123456789-";
    const size_t length = strlen(word);
    for (const char *at = text; (at = strstr(at, word)); at++)
        if ((at == text || !strchr(letters, at[-1]))
            && (!at[length] || !strchr(letters, at[length])))
            return 1;
    return 0;
}

/* Each method of the table, and what it refuses, where a user looks for it. */
START_TEST(help_and_manual_know_every_method)
{
    static char manual[1 << 16];
    read_file("src/program/manual/fvi.1", manual, sizeof manual);
    ck_assert_int_eq(fvi("run --help"), 0);
    for (size_t i = 0; fvi_methods[i]; i++) {
        const char *name = fvi_methods[i]->name;
        ck_assert_msg(stands_in(name, out), "%s is not in run --help", name);
        ck_assert_msg(stands_in(name, manual), "%s is not in fvi.1", name);
    }
    ck_assert(!stands_in("fvi-lobatto1", out) && !stands_in("euler", manual));
    ck_assert_int_eq(fvi("methods"), 0);
    const char *at = out;
    for (size_t i = 0; fvi_methods[i]; i++) {
        const fvi_method *m = fvi_methods[i];
        char line[100];
        snprintf(line, sizeof line, "%s\t%s\t%s\n", m->name, m->order,
                 m->memory);
        ck_assert_msg(strncmp(at, line, strlen(line)) == 0, "%s", at);
        at += strlen(line);
    }
    ck_assert(*at == '\0');
}
END_TEST

/* Each word of a law and each element of a material, where a user looks for it. The help and the errors list the words
 * themselves. */
START_TEST(manual_completions_and_python_know_every_law)
{
    static char text[5][1 << 17];
    static const char *const files[] = { "src/program/manual/fvi.1", "src/program/manual/fvi.bash",
                                         "src/program/manual/fvi.zsh", "src/python/fvi/_material.py" };
    for (size_t f = 0; f < LEN(files); f++)
        read_file(files[f], text[f], sizeof text[f]);
    ck_assert_int_eq(fvi("fit --help"), 0);
    for (size_t i = 0; fvi_law_formulas[i].form; i++) {
        char word[30];
        snprintf(word, sizeof word, "%.*s:", (int)strcspn(fvi_law_formulas[i].form, ":"), fvi_law_formulas[i].form);
        ck_assert_msg(strstr(text[0], fvi_law_formulas[i].form) != NULL, "%s is not in fvi.1", word);
        for (size_t f = 1; f <= 2; f++)
            ck_assert_msg(strstr(text[f], word) != NULL, "%s is not in %s", word, files[f]);
    }
    for (size_t i = 0; fvi_element_words[i]; i++) {
        ck_assert_msg(stands_in(fvi_element_words[i], out), "%s is not in fit --help", fvi_element_words[i]);
        ck_assert_msg(stands_in(fvi_element_words[i], text[3]), "%s is not in _material.py", fvi_element_words[i]);
    }
}
END_TEST

/* The help of each command, by each of its names. */
START_TEST(help_is_asked_for_in_many_ways)
{
    static const char *const ways[][3] = {
        { "help", "--help", "-h" },
        { "help run", "run --help", "run -h" },
        { "help exact", "exact --help", "exact --alpha 0.3 -h" },
        { "help sweep", "sweep --help", "sweep --vary alpha=0:1:2 -h" },
        { "help fit", "fit --help", "fit -h" },
        { "help gradient", "gradient --help", "gradient -h" },
        { "help response", "response --help", "response --omega 1 -h" },
        { "help poles", "poles --help", "poles --shapes -h" },
        { "help coefficients", "coefficients --help", "coefficients -h" },
        { "help methods", "methods --help", "methods -h" }
    };
    for (size_t i = 0; i < LEN(ways); i++) {
        char *want = NULL;
        for (size_t j = 0; j < 3; j++) {
            ck_assert_msg(fvi(ways[i][j]) == 0, "%s: %s", ways[i][j], err);
            ck_assert_str_eq(err, "");
            ck_assert(strncmp(out, "usage: fvi ", 11) == 0);
            ck_assert_ptr_nonnull(strstr(out, "\nexample"));
            if (j == 0)
                want = strdup(out);
            ck_assert_str_eq(out, want);
        }
        free(want);
    }
    ck_assert_int_eq(fvi("help run"), 0);
    ck_assert_ptr_nonnull(strstr(out, "[held]"));
    ck_assert_ptr_nonnull(strstr(out, "\n  zener:R,A,T         R s^{2A}/(1 + T s^{2A})\n"));
    ck_assert_ptr_nonnull(strstr(out, "\n  duffing:C,G         C x^2/2 + G x^4/4, "));
    ck_assert_ptr_nonnull(strstr(out, "\n                      stretched by r: "));
    ck_assert_int_eq(fvi("help run x"), 2);
    ck_assert_int_eq(fvi("run -h0.1"), 2); /* not the step, nor the help */
}
END_TEST

/* A help lists the options of run that its command takes, and no others: completions are
 * made of it. (An exact solution has no parameter, nor a fit many masses: --let and
 * --dimension lead to no more than a reason.) */
START_TEST(a_help_lists_what_its_command_takes)
{
    static const char *const commands[] = { "exact", "fit", "gradient",
                                            "sweep", "response", "poles" };
    static char of_run[16000], of_it[16000];
    ck_assert_int_eq(fvi("run --help"), 0);
    strcpy(of_run, out);
    for (size_t i = 0; i < LEN(commands); i++) {
        char line[100], name[40];
        snprintf(line, sizeof line, "%s --help", commands[i]);
        ck_assert_int_eq(fvi(line), 0);
        strcpy(of_it, out);
        for (const char *at = of_run; (at = strstr(at, "\n  --")); at++) {
            snprintf(name, sizeof name, "%.*s", (int)strcspn(at + 3, " ,\n"),
                     at + 3);
            snprintf(line, sizeof line, "%s %s %s", commands[i],
                     strcmp(commands[i], "sweep") == 0 ? "--vary alpha=0:1:2"
                                                       : "",
                     name);
            ck_assert_int_eq(fvi(line), 2);
            const int taken = !strstr(err, "not an option of this command");
            const char *listed = of_it;
            const size_t length = strlen(name);
            while ((listed = strstr(listed, name))
                   && !strchr(" \n", listed[length]))
                listed++;
            ck_assert_msg(taken == (listed != NULL)
                              || strcmp(name, "--let") == 0
                              || strcmp(name, "--dimension") == 0,
                          "%s", line);
        }
    }
}
END_TEST

/* What bash would offer behind these words. */
static const char *offered(const char *words)
{
    char line[500];
    snprintf(line, sizeof line,
             "command -v bash > /dev/null || exit 9; mkdir -p bin; "
             "ln -sf \"$FVI\" bin/fvi; PATH=$PWD/bin:$PATH bash -c '. "
             "\"$SOURCES\"/program/manual/fvi.bash; COMP_WORDS=(%s); "
             "COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _fvi; "
             "echo \" ${COMPREPLY[*]} \"'",
             words);
    return shell(line) == 9 ? NULL : out;
}

START_TEST(completions_are_what_the_program_says)
{
    if (!offered("fvi r"))
        return;
    ck_assert_str_eq(out, " response run \n");
    ck_assert_str_eq(offered("fvi response --of m"), " mobility moduli \n");
    ck_assert_ptr_nonnull(strstr(offered("fvi \"\""), " coefficients "));
    ck_assert_ptr_nonnull(strstr(offered("fvi help \"\""), " exact "));
    ck_assert_str_eq(offered("fvi run --alp"), " --alpha \n");
    ck_assert_str_eq(offered("fvi coefficients --k"), "  \n");
    ck_assert_str_eq(offered("fvi sweep --alp"), " --alpha \n");
    ck_assert_str_eq(offered("fvi methods --"), "  \n");
    ck_assert_str_eq(offered("fvi help run --"), "  \n");
    ck_assert_str_eq(offered("fvi --version \"\""), "  \n");
    ck_assert_str_eq(offered("fvi sweep --pl"), "  \n");
    ck_assert_str_eq(offered("fvi run --step-"), " --step-error \n");
    ck_assert_str_eq(offered("fvi run --memory e"), " exponentials \n");
    offered("fvi run --method \"\"");
    for (size_t i = 0; fvi_methods[i]; i++)
        ck_assert_ptr_nonnull(strstr(out, fvi_methods[i]->name));
    static char words[sizeof out];
    strcpy(words, offered("fvi run --"));
    for (const char *at = words; (at = strstr(at, " --")); at++) {
        char line[100];
        snprintf(line, sizeof line, "run %.*s", (int)strcspn(at + 1, " \n"),
                 at + 1);
        ck_assert_msg(fvi(line) == 0 || !strstr(err, "no such"), "%s", err);
    }
    ck_assert_int_eq(shell("command -v zsh > /dev/null || exit 0; zsh -n "
                           "\"$SOURCES\"/program/manual/fvi.zsh"),
                     0);
}
END_TEST

/* As elsewhere in a shell; behind them a word is no option, and here none is expected. */
START_TEST(two_dashes_end_the_options_of_each_command)
{
    static const char *const lines[] = { "run --steps 2 --", "exact --steps 2 --", "coefficients --", "methods --",
                                         "gradient --steps 2 --", "poles --", "response --omega 1 --",
                                         "sweep --vary rho=1,2 --steps 2 --", "fit --design --fit rho --sigma 1 --" };
    for (size_t i = 0; i < LEN(lines); i++)
        ck_assert_msg(fvi(lines[i]) == 0 && *err == '\0' && *out, "%s: %s", lines[i], err);
    ck_assert_refused("gradient -- --steps=2", "fvi: '--steps=2': not expected here");
}
END_TEST

int main(void)
{
    char *sources = realpath("src", NULL);
    setenv("SOURCES", sources ? sources : "src", 1);
    free(sources);
    Suite *suite = suite_create("the program fvi: help, manual, completions");
    ADD_CASE(suite, "help", help_and_manual_know_every_method, manual_completions_and_python_know_every_law,
             help_is_asked_for_in_many_ways,
             two_dashes_end_the_options_of_each_command,
             a_help_lists_what_its_command_takes,
             completions_are_what_the_program_says);
    return run_suite_of_program(suite);
}
