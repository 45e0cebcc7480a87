/* tests/run/processor_without_vectors.c -- A processor that has no AVX2 and no fma, for
 * the code that asks which clone of a sum it may take.
 *
 * libgcc asks the processor in an object of its archive. A program that is linked with
 * these definitions does not take that object, so each clone is the default one, on
 * any machine. A tunable of the C library would not do: it hides nothing from libgcc. */

/* The names and the layout are libgcc's; zero means that a feature is not there. */
struct {
    unsigned vendor, type, subtype, features[1];
} __cpu_model;
unsigned __cpu_features2[16];

int __cpu_indicator_init(void);
int __cpu_indicator_init(void)
{
    return 0;
}
