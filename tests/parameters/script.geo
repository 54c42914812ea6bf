SystemCall "mkdir results"; // run, it leaves what no refusal leaves
Point(1) = {0, 0, 0, 1};
