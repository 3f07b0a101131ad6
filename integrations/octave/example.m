% Pushes a needle through the membranes of a scene file and prints the force. SCENE is the path of the file.
insertion = PuncturaInsertion(fileread(getenv('SCENE')));
rate = 1600;
depth = -1e-3 + 10e-3 * (0:rate) / rate;                       % one second at 10 mm/s, straight down
forces = insertion.run([0 * depth; -depth; 0 * depth], [0; -1; 0]);
printf('%6.2f mm  %7.4f N\n', [1e3 * depth(1:80:end); forces(2, 1:80:end)]);
