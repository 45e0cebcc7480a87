// H 17: two, three and four stages; the scene is in orders.js.
FVI_LIVE.orders("lobatto", ["fvi-lobatto2", "fvi-lobatto3", "fvi-lobatto4"]);
