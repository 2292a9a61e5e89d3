use drypoint_reference::volume_stippling::try_points;
use drypoint_scene::glam::DVec3;
fn main(){
    let each=25; let r=45.0; let mut cells=vec![]; let mut normals=vec![];
    for z in 0..100u32 { for y in 0..100u32 { for x in 0..100u32 {
        let d=DVec3::new(x as f64,y as f64,z as f64)-DVec3::splat(50.0); if (d.length()-r).abs()<0.9 {cells.push([x,y,z]);normals.push(d.normalize());} }}}
    let t=std::time::Instant::now();
    let pts=try_points(&cells,&normals,0.5,each,true);
    let dt=t.elapsed().as_secs_f64();
    println!("{} pts {:.3}s {:.2}us/pt",pts.len(),dt,dt*1e6/pts.len() as f64);
}
