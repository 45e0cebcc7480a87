/* src/problem/formulas.c -- List the formulas of the words of a problem. All help texts take them from here; the laws
 * of damping have their formulas in kernel/kernel_classes.c. */
#include <fvi/formulas.h>

#include <stdio.h>

const fvi_formula fvi_potential_formulas[] = {
    { "harmonic:C", "C x^2/2, of each coordinate" },
    { "duffing:C,G", "C x^2/2 + G x^4/4, of each coordinate" },
    { "pendulum:G", "G (1 - cos x), of each coordinate" },
    { "free", "0" },
    { "chain:D,C,G", "D masses between two walls, and D + 1 springs that are\n"
                     "stretched by r: the sum of C r^2/2 + G r^4/4" },
    { NULL, NULL },
};

const fvi_formula fvi_force_formulas[] = {
    { "step:A,T", "A for 0 <= t <= T, then 0" },
    { "cosine:A,W", "A cos(W t)" },
    { "impulse:J,T", "every momentum jumps by J at T" },
    { "file:F.tsv", "rows t, F, linear in between" },
    { NULL, NULL },
};

const fvi_formula fvi_past_formulas[] = {
    { "held", "at rest at x0: a damper acts on x - x0, and so does a\n"
              "spring within its law" },
    { "caputo", "the same for orders 2A <= 1; above 1 the body came along\n"
                "a straight line: on x - x0 - t v0" },
    { "rl", "at 0, then put at x0: on x. No motion with x0 or C x0\n"
            "not 0 and 2A > 1: fvi warns, others refuse" },
    { NULL, NULL },
};

static const struct {
    const char *title;
    const fvi_formula *list;
} groups[] = {
    { "laws of damping: C(s) of the force C(d/dt) (x - x0); ' + ' adds several", fvi_law_formulas },
    { "potentials U; the force is -U'", fvi_potential_formulas },
    { "forces F(t) on every coordinate", fvi_force_formulas },
    { "the past, before t = 0", fvi_past_formulas },
};

typedef struct {
    char *text;
    size_t size, length;
} page;

static void add(page *to, const char *part, int width)
{
    const size_t room = to->size > to->length ? to->size - to->length : 0;
    const int n = snprintf(room ? to->text + to->length : NULL, room, "%-*s", width, part);
    to->length += n > 0 ? (size_t)n : 0;
}

/* Further lines of a formula are indented as far as its first line. */
static void add_formula(page *to, const fvi_formula *f)
{
    char letter[2] = "";
    add(to, "  ", 0);
    add(to, f->form, 20);
    for (const char *at = f->formula; *at; at++) {
        letter[0] = *at;
        add(to, letter, 0);
        if (*at == '\n')
            add(to, "", 22);
    }
    add(to, "\n", 0);
}

size_t fvi_formulas_write(size_t size, char *text)
{
    page to = { text, size, 0 };
    for (size_t i = 0; i < sizeof groups / sizeof *groups; i++) {
        add(&to, groups[i].title, 0);
        add(&to, ":\n", 0);
        for (const fvi_formula *f = groups[i].list; f->form; f++)
            add_formula(&to, f);
    }
    return to.length;
}
