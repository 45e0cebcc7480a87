# The example of README.md, from the command line.
#> example
build/fvi run --potential duffing:1,0.5 --alpha 0.3 --rho 0.4 --method fvi-lobatto3 \
    --h 0.1 --steps 200 --columns t,x
#< example
